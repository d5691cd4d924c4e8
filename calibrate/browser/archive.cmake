# Writes the data that the module needs into one file: of each its path, its length in bytes and its content, as
# browser/main.cpp unpacks them. The laws lie beside the style for LAMMPS, as they are installed.
# Variables: source, output.
file(GLOB_RECURSE apparatus RELATIVE ${source}/data ${source}/data/apparatus/*.json)
file(GLOB_RECURSE style RELATIVE ${source}/data ${source}/data/lammps/*)
file(GLOB_RECURSE laws RELATIVE ${source} ${source}/core/laws/*.h ${source}/core/laws/*.cpp)
list(APPEND laws core/inline.h core/target.h core/vec3.h calibrate/base/field.h calibrate/laboratory/names.h)
file(WRITE ${output} "")
function(pack file name)
  file(SIZE ${file} bytes)
  file(READ ${file} content)
  file(APPEND ${output} "${name}\n${bytes}\n${content}")
endfunction()
foreach(file IN LISTS apparatus style)
  pack(${source}/data/${file} ${file})
endforeach()
foreach(file IN LISTS laws)
  pack(${source}/${file} lammps/${file})
endforeach()
