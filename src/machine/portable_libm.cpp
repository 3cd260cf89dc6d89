// Elementary functions that give the same bits on every x86-64 processor.
//
// The C library chooses variants of sin, exp, ... by processor, with or without fused
// multiply-adds, and their last bits differ. Its 80-bit functions have one variant only. The
// functions below round the 80-bit results, which makes nearly all of them correctly rounded. No hot
// loop calls them. Calls of sin(), exp(), ... in this project's code, header libraries included, reach
// them by the linker's option --wrap (src/CMakeLists.txt); shared libraries and programs that link the
// installed libraries keep the C library's functions.
#include <cmath>

#if defined(__x86_64__) && defined(__linux__)

extern "C" {
double __wrap_sin(double x) noexcept {
    return static_cast<double>(sinl(x));
}
double __wrap_cos(double x) noexcept {
    return static_cast<double>(cosl(x));
}
double __wrap_tan(double x) noexcept {
    return static_cast<double>(tanl(x));
}
double __wrap_asin(double x) noexcept {
    return static_cast<double>(asinl(x));
}
double __wrap_acos(double x) noexcept {
    return static_cast<double>(acosl(x));
}
double __wrap_atan(double x) noexcept {
    return static_cast<double>(atanl(x));
}
double __wrap_atan2(double y, double x) noexcept {
    return static_cast<double>(atan2l(y, x));
}
double __wrap_exp(double x) noexcept {
    return static_cast<double>(expl(x));
}
double __wrap_log(double x) noexcept {
    return static_cast<double>(logl(x));
}
double __wrap_pow(double x, double y) noexcept {
    return static_cast<double>(powl(x, y));
}
void __wrap_sincos(double x, double* sine, double* cosine) noexcept {
    *sine = static_cast<double>(sinl(x));
    *cosine = static_cast<double>(cosl(x));
}
// called by std::exp(std::complex)
__extension__ __complex__ double __wrap_cexp(__complex__ double z) noexcept {
    const long double size = expl(__real__ z);
    __complex__ double result;
    __real__ result = static_cast<double>(size * cosl(__imag__ z));
    __imag__ result = static_cast<double>(size * sinl(__imag__ z));
    return result;
}
}

#endif
