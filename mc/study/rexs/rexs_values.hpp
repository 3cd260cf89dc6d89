// Units of REXS attributes.
#pragma once

#include <initializer_list>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "mc/study/rexs/rexs_model.hpp"

namespace gearpod::mc {

// Quantities that are read, each with the unit in which it is returned.
enum class RexsQuantity {
    number,     // none
    length,     // mm
    angle,      // deg
    modulus,    // Pa
    stiffness,  // N/m
    speed,      // rpm
    torque,     // N m
};

// Factor that converts a value of this unit to the quantity's unit. Blanks do not matter. Empty if
// the unit is not one of the quantity.
std::optional<double> rexs_factor(std::string_view unit, RexsQuantity quantity);

// Units of a quantity for messages: "mm, m, ...".
std::string rexs_units(RexsQuantity quantity);

// Values of REXS attributes in fixed units, with problems and a record of the attributes used.

class RexsValues {
  public:
    RexsValues(const RexsModel& model, Problems& problems) : model_(model), problems_(problems) {}

    const RexsModel& model() const { return model_; }

    // Number of an attribute in the quantity's unit; empty if it is missing. A value that is no
    // finite number, or has another unit, is a problem.
    std::optional<double> number(const RexsComponent& component, std::string_view attribute,
                                 RexsQuantity quantity);
    // The same for the first of several spellings that the component has.
    std::optional<double> number(const RexsComponent& component,
                                 std::initializer_list<std::string_view> attributes,
                                 RexsQuantity quantity);
    std::optional<int> count(const RexsComponent& component, std::string_view attribute);
    // True for "true"; empty if the attribute is missing. For an array, of its first value.
    std::optional<bool> flag(const RexsComponent& component, std::string_view attribute);

    // Value that several components give, such as both flanks of a gear. Values that differ are a
    // problem that names both.
    std::optional<double> common(const std::vector<const RexsComponent*>& components,
                                 std::initializer_list<std::string_view> attributes,
                                 RexsQuantity quantity);

    void reject(const RexsComponent& component, std::string_view attribute, std::string what,
                std::string remedy = "");
    // Records a component whose attributes are all listed in the notes or used.
    void consider(const RexsComponent& component) { considered_.insert(&component); }

    // Attributes of considered components that were not used, and components that were not
    // considered, one line for each kind.
    std::vector<std::string> unused() const;

  private:
    const RexsModel& model_;
    Problems& problems_;
    std::set<const RexsAttribute*> used_;
    std::set<const RexsComponent*> considered_;
};

}  // namespace gearpod::mc
