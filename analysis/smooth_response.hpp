// POD from responses whose mean is no straight line, or whose scatter changes with the size:
//
//   response = mean(size) + scatter(size) e,   scatter = sigma (size / middle)^growth,
//
// with e standard normal. The mean is monotone: its slope is piecewise linear and not negative (a
// quadratic monotone spline, J. O. Ramsay, Stat. Sci. 3 (1988), 425-441). Values of one specimen
// are correlated equally. The bounds come from tables simulated from the fit and fitted like it (R.
// Beran, J. Am. Stat. Assoc. 83 (1988), 687-697). The seed is fixed.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "analysis/pod/pod_curve.hpp"
#include "analysis/pod/response_fit.hpp"

namespace gearpod::analysis {

class SmoothResponse {
  public:
    // Fits the model by maximum likelihood, and its bounds at the confidence. Responses rise with
    // the size for Alarm::high, and fall for Alarm::low. See refusal().
    SmoothResponse(const ResponseRows& rows, double threshold, Alarm alarm, double confidence);

    // Reason why there is no fit: too few specimens or sizes, or residuals that are not normal. ""
    // if there is one.
    const std::string& refusal() const { return refusal_; }
    double mean(double size) const;
    double scatter(double size) const;
    double growth() const { return growth_; }  // exponent of the scatter
    // Correlation of two values of one specimen.
    double correlation() const { return correlation_; }
    double normality() const { return normality_; }  // p-value of the standardised residuals
    const SizeBounds& a50() const { return a50_; }
    const SizeBounds& a90() const { return a90_; }
    // POD with its bounds at sizes from the smallest to the largest, which are those of the table.
    const std::vector<PodPoint>& band() const { return band_; }
    double smallest() const { return nodes_.front(); }
    double largest() const { return nodes_.back(); }

  private:
    static constexpr int kNodes = 4;
    using Slopes = std::array<double, kNodes + 1>;  // constant, then the slope at every node

    SmoothResponse() = default;  // a copy of the nodes is fitted to a simulated table
    Slopes basis(double size) const;
    void fit(const ResponseRows& rows, double side);
    void fit_mean(const std::vector<Slopes>& bases, const std::vector<double>& values,
                  const std::vector<double>& weights, double side);
    void fit_scatter(const ResponseRows& rows, const std::vector<Slopes>& bases);
    double at(const Slopes& basis) const;
    std::vector<double> standardised(const ResponseRows& rows) const;
    void check(const ResponseRows& rows);
    void add_bounds(const ResponseRows& rows, double threshold, double side, double confidence);
    // Distance of the mean beyond the threshold in scatters.
    double distance(double size, double threshold, double side) const;

    std::string refusal_;
    std::array<double, kNodes> nodes_{};
    Slopes slopes_{};
    double middle_ = 1.0, sigma_ = 0.0, growth_ = 0.0, correlation_ = 0.0, normality_ = 1.0;
    int active_ = 0;  // coefficients of the mean that are not zero
    SizeBounds a50_, a90_;
    std::vector<PodPoint> band_;
};

}  // namespace gearpod::analysis
