#include "stiffness/foundation/foundation_models.hpp"

#include <fmt/format.h>

#include <stdexcept>

#include "stiffness/foundation/elastic_ring.hpp"
#include "stiffness/foundation/sainsot.hpp"

namespace gearpod::stiffness {

namespace {

bool has_foundation(const gears::Gear& gear, FoundationModel model) {
    return model == FoundationModel::elastic_ring ||
           (model == FoundationModel::sainsot && !gear.internal);
}

}  // namespace

std::vector<std::string> foundation_warnings(const gears::Gear& gear, Profile profile,
                                             FoundationModel model, double body_radius_m) {
    if (model != FoundationModel::sainsot || gear.internal || !(body_radius_m > 0))
        return {};
    const ToothProfile tooth(gear, profile);
    std::vector<std::string> warnings;
    const auto check = [&](const char* what, double value, double low, double high) {
        if (value < low || value > high)
            warnings.push_back(
                fmt::format("{} of {} teeth is {:.3g}; Sainsot's formula is fitted "
                            "from {} to {} (use the elastic ring)",
                            what, gear.teeth, value, low, high));
    };
    check("half the angle of the root of one", tooth.root_half_angle(),
          SainsotFoundation::kAngleMin, SainsotFoundation::kAngleMax);
    check("root radius over bore radius", tooth.root_radius() / body_radius_m,
          SainsotFoundation::kRadiiMin, SainsotFoundation::kRadiiMax);
    return warnings;
}

std::unique_ptr<const FilletFoundation> make_foundation(const gears::Gear& gear,
                                                        const Material& material, Profile profile,
                                                        FoundationModel model,
                                                        double body_radius_m) {
    if (!has_foundation(gear, model))
        return nullptr;
    const ToothProfile tooth(gear, profile);
    const double root = tooth.root_radius();
    if (gear.internal ? !(body_radius_m > root) : !(body_radius_m > 0 && body_radius_m < root))
        throw std::invalid_argument(fmt::format(
            "the body of {} teeth is held at a radius of {} m, which is not {} its root circle of "
            "{:.5g} m",
            gear.teeth, body_radius_m, gear.internal ? "outside" : "inside", root));
    if (model == FoundationModel::sainsot)
        return std::make_unique<SainsotFoundation>(tooth, material, body_radius_m);
    return std::make_unique<ElasticRing>(tooth, gear.teeth, material, body_radius_m);
}

}  // namespace gearpod::stiffness
