# Makes a source file of text files: what `embedded_text` (base/embedded_text.h) answers with.
file(GLOB texts RELATIVE ${CMAKE_CURRENT_SOURCE_DIR} CONFIGURE_DEPENDS laboratory/templates/* */texts/*)
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${texts})
set(cases "")
foreach(text IN LISTS texts)
  file(READ ${text} content)
  string(APPEND cases "  if (file == \"${text}\") return R\"text(${content})text\";\n")
endforeach()
set(embedded_texts ${CMAKE_CURRENT_BINARY_DIR}/embedded_texts.cpp)
file(CONFIGURE OUTPUT ${embedded_texts} @ONLY CONTENT "#include \"calibrate/base/embedded_text.h\"

std::optional<std::string_view> pastefit::embedded_text(std::string_view file) {
@cases@  return std::nullopt;
}
")
