#include "stiffness/piecewise_curves.hpp"

#include <algorithm>
#include <limits>

namespace gearpod::stiffness {
namespace {

constexpr int kCurveNodes = ToothPairCurve::kMaxTerms;

// Largest number of terms of an accepted series. A series with more terms may omit significant
// ones, so its piece is cut near its softer end: the stiffness of a tooth cracked past its centre
// line falls to zero within a short layer.
constexpr int kResolvedTerms = 32;
constexpr double kCut = 0.15;
constexpr int kMaxCuts = 6;

// Length in mesh periods below which a piece is merged with its neighbour.
constexpr double kShortestPiece = 1e-8;

constexpr int kPieceNodes = 32;
constexpr int kTermsThatEnd = 26;  // more terms may mean that the omitted ones are not negligible
constexpr int kHalvings = 8;

}  // namespace

void ToothPairCurve::operator()(std::span<const double> tau, const Stretch& stretch,
                                std::span<double> stiffness) const {
    EXPECTS(ascend(tau));
    std::fill(stiffness.begin(), stiffness.end(), 0.0);
    for (const Piece& piece : pieces_) {
        if (piece.end <= stretch.begin + kPositionTolerance ||
            piece.begin >= stretch.end - kPositionTolerance)
            continue;
        const auto [first, count] = positions_within(tau, piece.begin, piece.end);
        evaluate_chebyshev({piece.coefficients.data(), static_cast<std::size_t>(piece.terms)},
                           piece.begin, piece.end, tau.subspan(first, count),
                           stiffness.subspan(first, count), 0.0);
    }
}

void ToothPairCurve::operator()(std::span<const double> tau, std::span<double> stiffness) const {
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    (*this)(tau, {-kInfinity, kInfinity}, stiffness);
}

double ToothPairCurve::operator()(double tau) const {
    double stiffness = 0;
    (*this)({&tau, 1}, {&stiffness, 1});
    return stiffness;
}

ToothPairCurve ToothPairFit::operator()(const Stiffness& stiffness, std::span<const double> breaks,
                                        double contact_ratio) const {
    ToothPairCurve curve;
    double begin = 0;
    for (const double position : breaks) {
        if (position < begin + kShortestPiece || position > contact_ratio - kShortestPiece)
            continue;
        add_piece(curve, stiffness, begin, position, kMaxCuts);
        begin = position;
    }
    add_piece(curve, stiffness, begin, contact_ratio, kMaxCuts);
    return curve;
}

void ToothPairFit::add_piece(ToothPairCurve& curve, const Stiffness& stiffness, double begin,
                             double end, int cuts) const {
    std::array<double, kCurveNodes> tau, values;
    const auto& points = transform_.points();  // descending
    for (int i = 0; i < kCurveNodes; ++i)
        tau[kCurveNodes - 1 - i] = 0.5 * (begin + end) + 0.5 * (end - begin) * points[i];
    stiffness(tau, values);
    if (std::all_of(values.begin(), values.end(), [](double k) { return k == 0; }))
        return;
    const bool softer_at_end = values.back() < values.front();
    std::reverse(values.begin(), values.end());
    ToothPairCurve::Piece piece{begin, end, 0, {}};
    transform_.fit(values, piece.coefficients);
    piece.terms = chebyshev_terms(piece.coefficients, tolerance_);
    if (piece.terms > kResolvedTerms && cuts > 0) {
        const double cut =
            softer_at_end ? end - kCut * (end - begin) : begin + kCut * (end - begin);
        add_piece(curve, stiffness, begin, cut, cuts - 1);
        add_piece(curve, stiffness, cut, end, cuts - 1);
        return;
    }
    curve.pieces_.push_back(piece);
}

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
    EXPECTS(ascend(t));
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
