#!/bin/sh
# Holds the compiler to the lockstep kernels: the eight-lane AVX-512 and the four-lane AVX2 code of
# OBJECT must be packed (full-width fused multiply-adds) and must call no scalar mathematics.
#   check_kernel_code.sh OBJECT
set -eu
objdump -dr --no-show-raw-insn "$1" | awk '
    /^[0-9a-f]+ </ {
        name = $2
        wide = name ~ /_8_x86_64_v4/
        kernel = wide || name ~ /_4_x86_64_v3/
        if (kernel) ++kernels[wide]
    }
    kernel && /vf[n]?m(add|sub)[0-9]+pd/ && $0 ~ (wide ? "zmm" : "ymm") { ++packed[name] }
    kernel && /vf[n]?m(add|sub)[0-9]+sd/ { ++scalar[name] }
    kernel && /R_X86_64_PL/ && $3 !~ /^(memcpy|memmove|memset)/ { print name " calls " $3; bad = 1 }
    END {
        if (!(0 in kernels && 1 in kernels)) { print "kernels are missing"; exit 1 }
        for (name in packed) {
            printf "%4d packed, %d scalar fused multiply-adds in %s\n",
                packed[name], scalar[name], name
            if (packed[name] < 100 || scalar[name] > 0) bad = 1
            ++seen
        }
        if (seen != kernels[0] + kernels[1]) { print "a kernel without packed arithmetic"; bad = 1 }
        exit bad
    }'
