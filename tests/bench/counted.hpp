// A number type that counts arithmetic operations. The step's templates run on it as on doubles, so
// the count is that of the operations in the kernels.
// Include this header before any header whose templates call std::fma: they find the overload below
// only if it is declared first.
#pragma once

#include <cmath>

namespace gearpod::bench {

struct Operations {
    long fma = 0, multiply = 0, add = 0, divide = 0;

    long instructions() const { return fma + multiply + add + divide; }
    // Arithmetic operations; a fused multiply-add counts as two.
    long flop() const { return 2 * fma + multiply + add + divide; }
    // Operations so far. Negations are not counted: they become part of a fused multiply-add or of
    // a subtraction.
    static Operations& done() {
        static Operations all;
        return all;
    }
};

struct Counted {
    double value = 0.0;

    Counted() = default;
    Counted(double v) : value(v) {}  // NOLINT: as a double converts
    explicit operator double() const { return value; }

    Counted operator-() const { return -value; }
    friend Counted operator+(Counted a, Counted b) {
        ++Operations::done().add;
        return a.value + b.value;
    }
    friend Counted operator-(Counted a, Counted b) {
        ++Operations::done().add;
        return a.value - b.value;
    }
    friend Counted operator*(Counted a, Counted b) {
        ++Operations::done().multiply;
        return a.value * b.value;
    }
    friend Counted operator/(Counted a, Counted b) {
        ++Operations::done().divide;
        return a.value / b.value;
    }
    Counted& operator+=(Counted b) { return *this = *this + b; }
    Counted& operator-=(Counted b) { return *this = *this - b; }
    Counted& operator*=(Counted b) { return *this = *this * b; }
};

}  // namespace gearpod::bench

namespace std {  // NOLINT: where the templates look for it
inline gearpod::bench::Counted fma(gearpod::bench::Counted a, gearpod::bench::Counted b,
                                   gearpod::bench::Counted c) {
    ++gearpod::bench::Operations::done().fma;
    return fma(a.value, b.value, c.value);
}
}  // namespace std
