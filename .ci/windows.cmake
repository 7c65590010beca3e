# Cross compilation for Windows on x86-64 with Debian's MinGW; programs run in Wine. What stands in build/windows/root is found alone: headers of
# libraries that are headers, linked to one by one, because those of this machine's own system stand beside them, and GoogleTest (.ci/windows).
set(CMAKE_SYSTEM_NAME Windows)
set(CMAKE_SYSTEM_PROCESSOR x86_64)
set(CMAKE_C_COMPILER x86_64-w64-mingw32-gcc-posix)
set(CMAKE_CXX_COMPILER x86_64-w64-mingw32-g++-posix)
set(CMAKE_RC_COMPILER x86_64-w64-mingw32-windres)
set(CMAKE_CROSSCOMPILING_EMULATOR /usr/lib/wine/wine64)
get_filename_component(root ${CMAKE_CURRENT_LIST_DIR}/../build/windows/root ABSOLUTE)
set(CMAKE_FIND_ROOT_PATH ${root})
foreach(kind INCLUDE LIBRARY PACKAGE)
  set(CMAKE_FIND_ROOT_PATH_MODE_${kind} ONLY)
endforeach()
set(CMAKE_FIND_ROOT_PATH_MODE_PROGRAM NEVER)
# Programs and libraries need nothing but Windows' own.
foreach(kind EXE SHARED MODULE)
  set(CMAKE_${kind}_LINKER_FLAGS_INIT "-static")
endforeach()
