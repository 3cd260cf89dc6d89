// Elementary functions that give the same bits on every x86-64 processor.
//
// The C library chooses among variants of sin, exp, ... by the processor: with fused multiply-adds
// where there are some, without elsewhere, and the last bit differs. Its 80-bit functions have one
// variant only. These definitions take the place of the double functions in every program that
// links the physics (libraries such as the FFT included) and round the 80-bit results, which also
// makes nearly all of them correctly rounded. No hot loop calls them.
#include <cmath>  // defines __GLIBC__ where it applies

#if defined(__x86_64__) && defined(__GLIBC__)

extern "C" {
double sin(double x) noexcept {
    return static_cast<double>(sinl(x));
}
double cos(double x) noexcept {
    return static_cast<double>(cosl(x));
}
double tan(double x) noexcept {
    return static_cast<double>(tanl(x));
}
double asin(double x) noexcept {
    return static_cast<double>(asinl(x));
}
double acos(double x) noexcept {
    return static_cast<double>(acosl(x));
}
double atan(double x) noexcept {
    return static_cast<double>(atanl(x));
}
double atan2(double y, double x) noexcept {
    return static_cast<double>(atan2l(y, x));
}
double exp(double x) noexcept {
    return static_cast<double>(expl(x));
}
double log(double x) noexcept {
    return static_cast<double>(logl(x));
}
double pow(double x, double y) noexcept {
    return static_cast<double>(powl(x, y));
}
void sincos(double x, double* sine, double* cosine) noexcept {
    *sine = static_cast<double>(sinl(x));
    *cosine = static_cast<double>(cosl(x));
}
__extension__ __complex__ double cexp(__complex__ double z) noexcept {  // of std::exp(std::complex)
    const long double size = expl(__real__ z);
    __complex__ double result;
    __real__ result = static_cast<double>(size * cosl(__imag__ z));
    __imag__ result = static_cast<double>(size * sinl(__imag__ z));
    return result;
}
}

#endif
