# Cross compilation to WebAssembly by Debian's emscripten. Its libc++ is older than C++20's; the headers of others are linked to alone, because
# those of this machine's own system stand beside them.
include(/usr/share/emscripten/cmake/Modules/Platform/Emscripten.cmake)
set(headers ${CMAKE_BINARY_DIR}/headers)
foreach(header xsimd xxhash.h)
  file(MAKE_DIRECTORY ${headers})
  file(CREATE_LINK /usr/include/${header} ${headers}/${header} SYMBOLIC)
endforeach()
set(BCH_XSIMD_INCLUDE_DIR ${headers})
set(BCH_XXHASH_INCLUDE_DIR ${headers})
set(Eigen3_DIR /usr/share/eigen3/cmake)
set(CMAKE_CXX_FLAGS_INIT "-msimd128 -fwasm-exceptions -Wno-unsupported-floating-point-opt -include ${CMAKE_CURRENT_LIST_DIR}/bit_cast.hpp")
