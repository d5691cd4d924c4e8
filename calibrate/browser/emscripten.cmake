# Toolchain of the browser's module: Debian's Emscripten, with the wrappers and libraries that .ci/browser put into the
# build folder.
cmake_path(SET browser NORMALIZE ${CMAKE_CURRENT_LIST_DIR}/../../build/browser)
set(EMSCRIPTEN_SYSTEM_PROCESSOR wasm32)
set(CMAKE_C_COMPILER ${browser}/tools/emcc)
set(CMAKE_CXX_COMPILER ${browser}/tools/em++)
set(CMAKE_AR ${browser}/tools/emar)
set(CMAKE_RANLIB ${browser}/tools/emranlib)
# Exceptions of WebAssembly itself: those in JavaScript would make every call that may throw a way through it.
set(CMAKE_C_FLAGS_INIT "-fwasm-exceptions -msimd128")
set(CMAKE_CXX_FLAGS_INIT "-fwasm-exceptions -msimd128")
include(/usr/share/emscripten/cmake/Modules/Platform/Emscripten.cmake)
list(APPEND CMAKE_FIND_ROOT_PATH ${browser}/prefix)
set(NLopt_cxx_DIR ${browser}/prefix/lib/cmake/nlopt)
