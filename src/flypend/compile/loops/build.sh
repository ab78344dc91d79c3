#!/bin/sh
# Compiles the loops to LLVM's bitcode, one file per loop, width and size of a pointer: sh build.sh [FOLDER]
#
# Needs clang 14, whose bitcode LLVM 15 and later read. Nothing is optimised here: that waits until sizes
# and programs are linked. The target is WebAssembly for every processor, since it passes vectors of any width by value
# and has no features of its own; all that remains of it in a file is the size of a pointer.
set -eu
here=$(cd "$(dirname "$0")" && pwd)
out=${1:-$here}
clang=${CLANG:-clang-14}
raw="-O2 -Xclang -disable-llvm-passes -emit-llvm -Wno-override-module"
# As `FLAGS` of flypend.compile.llvm.vector: NaN and infinity keep their meaning.
floats="-ffp-contract=fast -fassociative-math -fno-signed-zeros -freciprocal-math -fno-trapping-math -fno-math-errno"
plain="-std=c++17 -ffreestanding -fno-exceptions -fno-rtti -fno-strict-aliasing -Qn -Wall -Wextra -Werror -Wno-psabi"
attributes="target-cpu|target-features|min-legal-vector-width|stack-protector-buffer-size|frame-pointer|no-[a-z-]*-math"

build() { # loop, lanes, bits of a number, bits of a pointer
    target="-target wasm$4-unknown-unknown"
    # shellcheck disable=SC2086
    "$clang" $target $raw $plain $floats -DWIDTH="$2" -DBITS="$3" -S -o - "$here/$1.cpp" |
        sed -E "s/ ?\"($attributes)\"=\"[^\"]*\"//g; s/^source_filename.*//" |
        "$clang" $target $raw -x ir -c -o "$out/$1_$2x$3_p$4.bc" -
}

for loop in runge_kutta elementary; do
    for lanes in 8x64 16x64 16x32 32x32; do build $loop "${lanes%x*}" "${lanes#*x}" 64; done
    for lanes in 1x64 2x64 1x32 2x32; do build $loop "${lanes%x*}" "${lanes#*x}" 32; done
done
build elementary 1 64 64
for lanes in 1 8; do build sampled "$lanes" 64 64; done
for lanes in 1 2; do build sampled "$lanes" 64 32; done
build worlds 8 64 64
build normals 8 64 64
for lanes in 1 8; do build horizon "$lanes" 64 64; done
build riccati 8 64 64
