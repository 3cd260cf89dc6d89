// Which method marches the equations of motion, and where within a step it needs the stiffness.
#pragma once

#include <vector>

namespace gearpod::lockstep {

// rk4: the classical Runge-Kutta method, explicit, order 4. newmark: average acceleration (beta
// 1/4, gamma 1/2), implicit, order 2, keeps the energy. sdirk3: Alexander (1977), three implicit
// stages, order 3, L-stable and stiffly accurate: it damps what is too fast for the step.
// generalized_alpha: Chung and Hulbert (1993), implicit, order 2, damps what is too fast for the
// step by a chosen factor. bs3: the explicit pair of Bogacki and Shampine (1989), order 3, which
// estimates its own error. central_difference: on the steps' middles, explicit, order 2, one
// evaluation a step.
enum class Integrator { rk4, newmark, sdirk3, generalized_alpha, bs3, central_difference };

constexpr bool is_explicit(Integrator integrator) {
    return integrator == Integrator::rk4 || integrator == Integrator::bs3 ||
           integrator == Integrator::central_difference;
}

// Whether the method has kernels that march singles.
constexpr bool marches_singles(Integrator integrator) {
    return integrator == Integrator::rk4 || integrator == Integrator::central_difference;
}

// What the motion is computed in within a mesh period; from one to the next it is double.
enum class Precision { double_precision, single_precision };

// Alexander's method: every stage has the same diagonal coefficient, a root of
// x^3 - 3 x^2 + 3/2 x - 1/6; the last stage is the end of the step.
struct Alexander {
    static constexpr double kDiagonal = 0.43586652150845899942;
    static constexpr double kSecond = (1.0 + kDiagonal) / 2.0;  // node of the second stage
    static constexpr double k21 = (1.0 - kDiagonal) / 2.0;
    static constexpr double k31 = -(6.0 * kDiagonal * kDiagonal - 16.0 * kDiagonal + 1.0) / 4.0;
    static constexpr double k32 = (6.0 * kDiagonal * kDiagonal - 20.0 * kDiagonal + 5.0) / 4.0;
};

// How far the acceleration of an implicit stage carries: the velocity by so much of a step, the
// position by so much of its square.
struct ImplicitSpan {
    double velocity = 0.0, position = 0.0;
};

// The generalized-alpha method. Its rho is the factor by which a step multiplies what is much too
// fast for it: 1 keeps it as Newmark's method does, 0 removes it at once. With 0.8 a mode that the
// step does not resolve halves in three steps, and what it does resolve loses next to nothing.
// The acceleration that it carries along belongs to a time `kLag` steps before the step's end.
struct ChungHulbert {
    static constexpr double kRho = 0.8;
    static constexpr double kMass = (2.0 * kRho - 1.0) / (kRho + 1.0);  // alpha_m
    static constexpr double kForce = kRho / (kRho + 1.0);               // alpha_f
    static constexpr double kGamma = 0.5 - kMass + kForce;
    static constexpr double kBeta = 0.25 * (1.0 - kMass + kForce) * (1.0 - kMass + kForce);
    static constexpr double kLag = kForce - kMass;
    static constexpr ImplicitSpan span() {
        constexpr double kPart = (1.0 - kForce) / (1.0 - kMass);
        return {kPart * kGamma, kPart * kBeta};
    }
};

// As study files name it.
const char* name(Integrator integrator);

// Positions within a step, ascending; 0 means the right limit there, 1 the left limit.
std::vector<double> stage_nodes(Integrator integrator);

// 0 for an explicit method.
ImplicitSpan implicit_span(Integrator integrator);

}  // namespace gearpod::lockstep
