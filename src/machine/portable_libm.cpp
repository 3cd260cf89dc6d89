// Elementary functions that give the same bits on every x86-64 processor.
//
// The C library chooses variants of sin, exp, ... by processor, with or without fused
// multiply-adds, and their last bits differ. Its 80-bit functions have one variant only. The
// definitions below replace the double functions in every program that links the physics, libraries
// such as the FFT included. They round the 80-bit results, which makes nearly all of them correctly
// rounded. No hot loop calls them.
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
// called by std::exp(std::complex)
__extension__ __complex__ double cexp(__complex__ double z) noexcept {
    const long double size = expl(__real__ z);
    __complex__ double result;
    __real__ result = static_cast<double>(size * cosl(__imag__ z));
    __imag__ result = static_cast<double>(size * sinl(__imag__ z));
    return result;
}
}

#endif
