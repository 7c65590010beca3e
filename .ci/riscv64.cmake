# Cross compilation for RISC-V on Debian, which has no libraries for it: headers are those of x86-64, so that nothing is
# linked.
set(CMAKE_SYSTEM_NAME Linux)
set(CMAKE_SYSTEM_PROCESSOR riscv64)
set(CMAKE_CXX_COMPILER riscv64-linux-gnu-g++)
set(TBB_DIR /usr/lib/x86_64-linux-gnu/cmake/TBB)
