#include "mc/study/schema/former_keys.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <regex>

#include "mc/files/input/find_in.hpp"
#include "mc/study/schema/schema.hpp"

namespace gearpod::mc {
namespace {

// Removed keys, as they were spelled without tables: a regular expression for the whole path.
// Studies that are stored in results state the value without effect.
struct RemovedKey {
    const char* path;
    std::string_view without_effect;  // value that is ignored; * for all, "" for none
    std::string_view remedy;
};
// clang-format off
constexpr RemovedKey kRemoved[] = {
    {"numerics.step_tolerance", "*", "remove it"},
    {"numerics.face_slices", "0", "remove it: crowned spur teeth have 8 slices, helical ones 4"},
    {"gearbox.planet_.*_factors", "", "planets are alike but for their pins: give pin_tangential_um or pin_radial_um in [gearbox]"},
    {"gearbox.planet_.*_scatter", "0", "planets are alike but for their pins: give pin_tangential_rms_um or pin_radial_rms_um in [gearbox]"},
    {"gearbox..*_root_relief_(um|length_mm)", "0", "give the same tip relief to the mating gear, whose tip meets this root"},
    {"gearbox.relief_shape", "linear", "remove it: relief is linear. A parabolic one is close to a linear one of the same amount and two thirds of the length"},
    {"gearbox.index_wave_um", "0", "give tooth_quality, whose grade contains waves of the index"},
    {"gearbox.profile_slope_um", "0", "give tooth_quality, whose grade contains profile slopes"},
    {"gearbox.sun_(rim|web)_mm", "", "remove it: the sun is solid; give rim_mm and web_mm in [gearbox.planet]"},
    {"gearbox.(pinion|gear)_(rim|web)_mm", "", "remove it, and multiply young_modulus_Pa by the gear blank factor of ISO 6336-1"},
    {"gearbox.mesh", "", "give tooth_profile = \"fillet\", from which the stiffness is computed, and tooth_quality for errors of the teeth"},
    {"gearbox.mesh_(.*stiffness_N_m|contact_ratio)", "", "give tooth_profile = \"fillet\", from which the stiffness is computed"},
    {"gearbox.mesh_error_.*", "", "give tooth_quality or pitch_error_um: errors of the teeth"},
    {"gearbox.sun_planet_error_phase_deg", "", "give error_phase_deg in [gearbox.ring_planet], relative to the sun meshes"},
    {"gearbox.mesh_damping_N_s_m", "", "give mesh_damping_ratio or mesh_damping_time_s"},
    {"gearbox.mesh_damping_alpha_1_s", "", "give mesh_damping_ratio: that of the most important natural frequency"},
    {"gearbox.mesh_damping_beta_s", "", "give it as mesh_damping_time_s, with effects.mesh_damping = \"proportional\""},
    {"gearbox.planet_crowning_um", "0", "add it to crowning_um in [gearbox.sun] and [gearbox.ring]: crowning of mating flanks adds"},
    {"gearbox.pinion_crowning_um", "0", "add it to crowning_um in [gearbox.gear]: crowning of mating flanks adds"},
    {"gearbox.sun_quality", "", "give this grade as tooth_quality, and those of the other gears as quality in their tables"},
    {"gearbox.pinion_quality", "", "give this grade as tooth_quality, and that of the gear as quality in [gearbox.gear]"},
    {"fault.(chip|break)_end", "first", "remove it: the end that engages first is damaged; the other one has the same loss, later by the overlap"},
    {"fault.pit_face_position_mm", "", "remove it: pits lie in the middle of the face width"},
    {"fault.height_waves?", "0", "remove it: the height of the crack varies from growth_height_mm to growth_end_height_mm without waves"},
    {"fault.slices", "16", "remove it: a spatial crack has 16 slices, whose error is 2e-5 of the stiffness"},
    {"operation.ring_speed_rpm", "", "give sun_speed_rpm or carrier_speed_rpm, each of which determines the speed of the ring"},
    {"operation.torque_fluctuation.*", "0", "give torque_noise and torque_noise_band_Hz, or speed_fluctuation"},
    {"effects.gravity_direction_deg", "-90", "remove it: gravity acts along -y, away from the sensor"},
    {"detection.false_alarms_per_year", "", "give false_alarms_per_1000_h, which is 0.114 for one in a year"},
    {"monitoring.sustained_records", "10", "remove it: eight of the next ten recordings sustain an alarm"},
    {"monitoring.sustained_share", "0.8", "remove it: eight of the next ten recordings sustain an alarm"},
    {"life.(marched|linear)_(torques|speeds)", "", "give life.integrated_torques and life.integrated_speeds, or leave the choice to interpolation_tolerance"},
    {"life.record_turns", "", "give record_s: a turn of the carrier takes 60 s over its speed in rpm"},
    {"life.fracture_toughness_MPa_m05", "", "give the depth at which the tooth breaks as last_depth_mm"},
    {"life.smallest_depth_mm", "", "remove it: interpolation_tolerance is relative to a crack of half of last_depth_mm"},
    {"ensemble.sampling", "plain", "remove it, and give more instances instead: gearboxes are drawn independently"},
    {"ensemble.until", "", "remove it; run --resume with more --instances adds gearboxes until an interval is narrow enough"},
};

constexpr FormerValue kFormerValues[] = {
    {"numerics.horizon", "reuse", "periodic", false},
    {"numerics.horizon", "superpose", "superposed", false},
    {"numerics.horizon", "march", "full", false},
    {"effects.mesh_damping", "constant", "ratio", true},
    {"effects.mesh_damping", "rayleigh", "ratio", true},
    {"numerics.integrator", "bs3", "rk4", true},
    {"numerics.integrator", "bathe", "sdirk3", true},
    {"numerics.integrator", "generalized-alpha", "sdirk3", true},
};
// clang-format on

// Present paths by former ones.
const std::map<std::string, std::string, std::less<>>& renamed_keys() {
    static const auto keys = [] {
        std::map<std::string, std::string, std::less<>> all;
        for (const Key& key : schema()) {
            if (key.section == "gearbox" && key.name.find('.') != std::string::npos) {
                all.emplace(flat_path(key.path()), key.path());
            }
        }
        return all;
    }();
    return keys;
}

// nullptr if the key was not removed. `path`: without "random.".
const RemovedKey* removed_key(const std::string& path) {
    constexpr std::size_t kLongest = 100;  // matching needs stack in proportion to the length
    if (path.size() > kLongest || is_table(path) || find_key(path) != nullptr) {
        return nullptr;
    }
    static const auto patterns = [] {
        std::vector<std::regex> all;
        for (const RemovedKey& key : kRemoved) {
            all.emplace_back(key.path);
        }
        return all;
    }();
    const std::string flat = flat_path(path);
    const auto found = std::ranges::find_if(
        patterns, [&](const std::regex& pattern) { return std::regex_match(flat, pattern); });
    return found == patterns.end() ? nullptr : &kRemoved[found - patterns.begin()];
}

bool has_no_effect(const RemovedKey& key, const Value& value) {
    const bool number = value.kind == Value::Kind::integer || value.kind == Value::Kind::number;
    const std::string text = number ? fmt::format("{:g}", value.number) : value.text;
    return key.without_effect == "*" || (!text.empty() && text == key.without_effect);
}

// Puts a value at that path below a table; false if there is one already.
bool put(Value& table, const std::vector<std::string>& path, const Entry& moved) {
    Value* parent = &table;
    for (const std::string& name : path) {
        if (parent->kind != Value::Kind::table) {
            return false;
        }
        Entry* entry = find_in(parent->entries, name, &Entry::name);
        if (entry == nullptr) {
            const auto next = std::ranges::upper_bound(parent->entries, name, {}, &Entry::name);
            entry = &*parent->entries.insert(next, {name, {}, moved.position});
            entry->value.position = moved.position;
        } else if (&name == &path.back()) {
            return false;
        }
        parent = &entry->value;
    }
    *parent = moved.value;
    return true;
}

}  // namespace

std::string current_path(const std::string& path) {
    const std::size_t start = path.starts_with("random.") ? 7 : 0;
    const std::size_t dot = std::min(path.find('.', start), path.size() - 1);
    const std::size_t end = std::min(path.find('.', dot + 1), path.size());
    const auto found = renamed_keys().find(path.substr(start, end - start));
    return found == renamed_keys().end() ? path
                                         : path.substr(0, start) + found->second + path.substr(end);
}

const FormerValue* former_value(std::string_view key, std::string_view value) {
    const auto found = std::ranges::find_if(kFormerValues, [&](const FormerValue& one) {
        return one.key == key && one.former == value;
    });
    return found == std::end(kFormerValues) ? nullptr : found;
}

std::string FormerKeys::renamed(const std::string& path, const Position& position) {
    std::string current = current_path(path);
    if (current != path) {
        const std::size_t dot = current.rfind('.');
        renamed_.push_back(
            {position.file, position.line, path, "is the spelling of an earlier version",
             fmt::format("write {} in [{}]", current.substr(dot + 1), current.substr(0, dot))});
    }
    return current;
}

// `prefix`: path of the table and a dot.
void FormerKeys::rename(Value& table, const std::string& prefix, Problems& problems) {
    std::vector<Entry> moved;
    std::erase_if(table.entries, [&](Entry& entry) {
        const std::string path = prefix + entry.name;
        const std::string key = path.starts_with("random.") ? path.substr(7) : path;
        const Position& at = entry.position;
        if (const RemovedKey* removed = removed_key(key)) {
            if (has_no_effect(*removed, entry.value)) {
                ignored_.push_back({at.file, at.line, path,
                                    "belongs to an earlier version and is ignored", "remove it"});
            } else {
                problems.push_back(
                    {at.file, at.line, path, "was removed", std::string(removed->remedy)});
            }
            return true;
        }
        if (is_table(key)) {
            rename(entry.value, path + ".", problems);
        } else if (current_path(path) != path) {
            moved.push_back(std::move(entry));
            return true;
        }
        return false;
    });
    for (const Entry& entry : moved) {
        const std::string current = renamed(prefix + entry.name, entry.position);
        if (!put(table, split(current.substr(prefix.size()), '.'), entry)) {
            problems.push_back({entry.position.file, entry.position.line, prefix + entry.name,
                                "is also given as " + current, "remove one of them"});
        }
    }
}

void FormerKeys::replace(Value& document, Problems& problems) {
    // Lists of keys.
    const auto rename_texts = [&](Value& table, std::string_view name) {
        if (Entry* list = find_in(table.entries, name, &Entry::name)) {
            for (Value& element : list->value.elements) {
                element.text = renamed(element.text, element.position);
            }
        }
    };
    for (Entry& section : document.entries) {
        rename(section.value, section.name + ".", problems);
        rename_texts(section.value, "uncertain_inputs");
        if (Entry* pairs = find_in(section.value.entries, "correlations", &Entry::name)) {
            for (Value& pair : pairs->value.elements) {
                rename_texts(pair, "between");
            }
        }
    }
}

std::string FormerKeys::replace(const std::string& assignment) {
    const std::size_t end = std::min(assignment.find_first_of("= \t"), assignment.size());
    return renamed(assignment.substr(0, end), {std::string(kOverrideFile), 0}) +
           assignment.substr(end);
}

Problems FormerKeys::notices() const {
    Problems all = ignored_;
    if (!renamed_.empty()) {
        all.push_back(renamed_.front());
        if (renamed_.size() > 1) {
            all.back().remedy +=
                fmt::format(", and {} more keys in the same way", renamed_.size() - 1);
        }
    }
    return all;
}

}  // namespace gearpod::mc
