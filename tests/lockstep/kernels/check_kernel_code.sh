#!/bin/sh
# Checks the compiler's output for the lockstep kernels. Code in OBJECT that fills registers of
# AVX-512 (eight doubles, sixteen singles) or AVX2 (four, eight, or twice as many) must be packed
# (full-width fused multiply-adds). It must call no scalar mathematics: only moves, memory,
# destructors and exceptions.
#   check_kernel_code.sh OBJECT
set -eu
objdump -dr --no-show-raw-insn "$1" | awk '
    # Mangled name of Compiled<integrate_mesh<Method, Motion<..., 8, double>>>::x86_64_v4.
    /^[0-9a-f]+ </ {
        name = $2
        single = name ~ /Li[0-9]+Ef/
        wide = name ~ /integrate_meshI.*x86_64_v4E/ && name ~ (single ? "Li16Ef" : "Li8E[dE]")
        kernel = wide || name ~ /integrate_meshI.*x86_64_v3E/ && name ~ (single ? "Li(8|16)Ef" : "Li[48]E[dE]")
        packed_fma = single ? "vfn?m(add|sub)[0-9]+ps" : "vfn?m(add|sub)[0-9]+pd"
        scalar_fma = "vfn?m(add|sub)[0-9]+s[sd]"
        kernel = kernel && name !~ /[.]cold/  # where exceptions unwind
        if (kernel) ++kernels
    }
    kernel && $0 ~ packed_fma && $0 ~ (wide ? "zmm" : "ymm") { ++packed[name] }
    kernel && $0 ~ scalar_fma { ++scalar[name] }
    kernel && /R_X86_64_PL/ && $3 !~ /^(memcpy|memmove|memset|_Zn|_Zd|_ZSt.*throw|_Unwind|_ZN.*11SingleState|_ZN.*D[012]Ev)/ {
        print name " calls " $3
        bad = 1
    }
    END {
        if (!kernels) { print "kernels are missing"; exit 1 }
        for (name in packed) {
            printf "%4d packed, %d scalar fused multiply-adds in %s\n",
                packed[name], scalar[name], name
            if (packed[name] < 60 || scalar[name] > 0) bad = 1
            ++seen
        }
        if (seen != kernels) { print "a kernel without packed arithmetic"; bad = 1 }
        exit bad
    }'
