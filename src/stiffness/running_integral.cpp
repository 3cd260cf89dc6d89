#include "stiffness/running_integral.hpp"

#include <algorithm>
#include <array>

#include "stiffness/teeth/position_range.hpp"

namespace gearpod::stiffness {

namespace {

constexpr int kPieceNodes = 32;
constexpr int kTermsThatEnd = 26;  // more terms may mean that the omitted ones are not negligible
constexpr int kHalvings = 8;

}  // namespace

RunningIntegral::RunningIntegral(const Curve& curve, std::span<const double> points,
                                 double tolerance) {
    for (std::size_t i = 0; i + 1 < points.size(); ++i)
        if (points[i] < points[i + 1])
            add_piece(curve, points[i], points[i + 1], tolerance, kHalvings);
}

void RunningIntegral::add_piece(const Curve& curve, double begin, double end, double tolerance,
                                int halvings) {
    static const ChebyshevTransform transform(kPieceNodes);
    const double middle = 0.5 * (begin + end);
    std::array<double, kPieceNodes> t, values, coefficients;
    for (int i = 0; i < kPieceNodes; ++i)  // the points are in descending order
        t[kPieceNodes - 1 - i] = middle + 0.5 * (end - begin) * transform.points()[i];
    curve(t, middle, values);
    std::reverse(values.begin(), values.end());
    transform.fit(values, coefficients);
    const int terms = chebyshev_terms(coefficients, tolerance);
    if (terms > kTermsThatEnd && halvings > 0) {
        add_piece(curve, begin, middle, tolerance, halvings - 1);
        add_piece(curve, middle, end, tolerance, halvings - 1);
        return;
    }
    pieces_.push_back(ChebyshevSeries::integral_of(
        std::span(coefficients).first(static_cast<std::size_t>(terms)), begin, end, whole_));
    whole_ = pieces_.back()(end);
}

void RunningIntegral::operator()(std::span<const double> t, std::span<double> values) const {
    std::fill(values.begin(), values.end(), whole_);
    if (pieces_.empty())
        return;
    for (std::size_t i = 0; i < t.size() && t[i] < pieces_.front().begin(); ++i)
        values[i] = 0;
    for (const ChebyshevSeries& piece : pieces_) {
        const auto [first, count] = positions_within(t, piece.begin(), piece.end());
        piece(t.subspan(first, count), values.subspan(first, count));
    }
}

}  // namespace gearpod::stiffness
