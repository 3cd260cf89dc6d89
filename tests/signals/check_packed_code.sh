#!/bin/sh
# Checks the compiler's output for kernels without lanes of gearboxes (src/signals). Code in OBJECT
# for AVX-512 and AVX2 must be packed, with full-width fused multiply-adds, and must call only
# functions that move memory.
#   check_packed_code.sh OBJECT KERNEL...
set -eu
object=$1
shift
objdump -dr --no-show-raw-insn "$object" | awk -v kernels="$*" '
    BEGIN { count = split(kernels, names, " ") }
    /^[0-9a-f]+ </ {
        kernel = ""
        for (i = 1; i <= count; ++i)
            if ($2 ~ ("8Compiled.*[0-9]" names[i] "E.*x86_64_v[34]")) kernel = names[i] " v" ($2 ~ /_v4/ ? 4 : 3)
        if (kernel != "") ++found[kernel]
    }
    kernel != "" && $0 ~ /vfn?m(add|sub)[0-9]+pd/ && $0 ~ (kernel ~ /v4/ ? "zmm" : "ymm") { ++packed[kernel] }
    kernel != "" && $0 ~ /vfn?m(add|sub)[0-9]+s[sd]/ { ++scalar[kernel] }
    kernel != "" && /R_X86_64_PL/ && $3 !~ /^mem(cpy|move|set)/ { print kernel " calls " $3; bad = 1 }
    END {
        for (i = 1; i <= count; ++i)
            for (v = 3; v <= 4; ++v) {
                kernel = names[i] " v" v
                printf "%4d packed, %d scalar fused multiply-adds in %s\n", packed[kernel], scalar[kernel], kernel
                if (!(kernel in found) || packed[kernel] == 0 || scalar[kernel] > 0) bad = 1
            }
        exit bad
    }'
