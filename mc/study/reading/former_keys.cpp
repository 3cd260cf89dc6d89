#include "mc/study/reading/former_keys.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <utility>

#include "mc/files/input/find_in.hpp"
#include "mc/study/schema/schema.hpp"

namespace gearpod::mc {
namespace {

// Keys with another name now, in addition to the keys of members and meshes.
constexpr std::pair<std::string_view, std::string_view> kRenamed[] = {
    {"life.marched_torques", "life.linear_torques"}, {"life.marched_speeds", "life.linear_speeds"}};

// Removed keys, as they were spelled without tables; * stands for any name. Studies that are stored
// in results state the values without effect.
struct RemovedKey {
    std::string_view path;
    std::string_view without_effect;  // value that is ignored; * for all, "" for none
    std::string_view remedy;
};
constexpr std::string_view kLikePlanets =
    "planets are alike but for their pins: give pin_tangential_um or pin_radial_um in [gearbox]";
constexpr std::string_view kMatingTip =
    "give the same tip relief to the mating gear, whose tip meets this root";
constexpr std::string_view kSolid =
    "remove it: sun and pinion are solid; give rim_mm and web_mm in [gearbox.planet] or "
    "[gearbox.gear]";
constexpr std::string_view kNoSquareWave =
    "give tooth_profile = \"fillet\", or a constant stiffness_N_m in [gearbox.mesh]";
constexpr std::string_view kOtherGrade =
    "give this grade as tooth_quality, and those of the other gears as quality in their tables";
constexpr std::string_view kFirstEnd =
    "remove it: the end that engages first is damaged; the other one gives the same loss, later by "
    "the overlap";
constexpr RemovedKey kRemoved[] = {
    {"numerics.step_tolerance", "*", "remove it"},
    {"gearbox.planet_bearing_*_factors", "", kLikePlanets},
    {"gearbox.planet_bearing_*_scatter", "0", kLikePlanets},
    {"gearbox.planet_mass_factors", "", kLikePlanets},
    {"gearbox.planet_mass_scatter", "0", kLikePlanets},
    {"gearbox.*_root_relief_um", "0", kMatingTip},
    {"gearbox.*_root_relief_length_mm", "", kMatingTip},
    {"gearbox.relief_shape", "linear",
     "remove it: relief is linear. A parabolic one is close to a linear one of the same amount and "
     "two thirds of the length"},
    {"gearbox.index_wave_um", "0", "give tooth_quality, whose grade contains waves of the index"},
    {"gearbox.profile_slope_um", "0", "give tooth_quality, whose grade contains profile slopes"},
    {"gearbox.sun_rim_mm", "", kSolid},
    {"gearbox.sun_web_mm", "", kSolid},
    {"gearbox.pinion_rim_mm", "", kSolid},
    {"gearbox.pinion_web_mm", "", kSolid},
    {"gearbox.mesh_low_stiffness_N_m", "", kNoSquareWave},
    {"gearbox.mesh_high_stiffness_N_m", "", kNoSquareWave},
    {"gearbox.mesh_contact_ratio", "", kNoSquareWave},
    {"gearbox.mesh_error_phase_deg", "", "remove it: the harmonics of mesh.error_um are in phase"},
    {"numerics.face_slices", "0", "remove it: crowned spur teeth have 8 slices, helical ones 4"},
    {"life.smallest_depth_mm", "",
     "remove it: interpolation_tolerance is relative to a crack of half of last_depth_mm"},
    {"gearbox.planet_crowning_um", "0",
     "add it to crowning_um in [gearbox.sun] and [gearbox.ring]: crowning of mating flanks adds"},
    {"gearbox.pinion_crowning_um", "0",
     "add it to crowning_um in [gearbox.gear]: crowning of mating flanks adds"},
    {"gearbox.sun_quality", "", kOtherGrade},
    {"gearbox.pinion_quality", "", kOtherGrade},
    {"fault.chip_end", "first", kFirstEnd},
    {"fault.break_end", "first", kFirstEnd},
    {"fault.pit_face_position_mm", "", "remove it: pits lie in the middle of the face width"},
};

constexpr FormerValue kFormerValues[] = {
    {"numerics.horizon", "reuse", "periodic", false},
    {"numerics.horizon", "superpose", "superposed", false},
    {"numerics.horizon", "march", "full", false},
    {"numerics.integrator", "bs3", "rk4", true},
    {"numerics.integrator", "bathe", "sdirk3", true},
    {"numerics.integrator", "generalized-alpha", "sdirk3", true}};

// Former spelling of every renamed key.
const std::map<std::string, std::string, std::less<>>& renamed_keys() {
    static const std::map<std::string, std::string, std::less<>> keys = [] {
        std::map<std::string, std::string, std::less<>> all(std::begin(kRenamed),
                                                            std::end(kRenamed));
        for (const Key& key : schema()) {
            if (key.section == "gearbox" && key.name.find('.') != std::string::npos) {
                all.emplace(flat_path(key.path()), key.path());
            }
        }
        return all;
    }();
    return keys;
}

bool matches(std::string_view pattern, std::string_view path) {
    const std::size_t star = pattern.find('*');
    if (star == std::string_view::npos) {
        return path == pattern;
    }
    const std::string_view front = pattern.substr(0, star), back = pattern.substr(star + 1);
    return path.size() > front.size() + back.size() && path.starts_with(front) &&
           path.ends_with(back);
}

bool has_no_effect(const RemovedKey& key, const Value& value) {
    const bool number = value.kind == Value::Kind::integer || value.kind == Value::Kind::number;
    const std::string text = number ? fmt::format("{:g}", value.number) : value.text;
    return key.without_effect == "*" || (!text.empty() && text == key.without_effect);
}

// Entry of that path below a table, created if absent; nullptr if another value is in the way.
Entry* entry_at(Value& table, const std::vector<std::string>& path, const Position& position) {
    Value* parent = &table;
    for (std::size_t i = 0;; ++i) {
        if (parent->kind != Value::Kind::table) {
            return nullptr;
        }
        Entry* entry = find_in(parent->entries, path[i], &Entry::name);
        if (entry == nullptr) {
            const auto next = std::ranges::upper_bound(parent->entries, path[i], {}, &Entry::name);
            entry = &*parent->entries.insert(next, {path[i], {}, position});
            entry->value.position = position;
        } else if (i + 1 == path.size()) {
            return nullptr;
        }
        if (i + 1 == path.size()) {
            return entry;
        }
        parent = &entry->value;
    }
}

}  // namespace

std::string current_path(const std::string& path) {
    const std::string_view random = "random.";
    const std::size_t start = path.starts_with(random) ? random.size() : 0;
    const std::size_t dot = path.find('.', start);
    const std::size_t end =
        dot == std::string::npos ? path.size() : std::min(path.find('.', dot + 1), path.size());
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
        renamed_.push_back({position, path, current});
    }
    return current;
}

// `prefix`: path of the section and a dot.
void FormerKeys::rename(Value& section, const std::string& prefix, Problems& problems) {
    std::vector<Entry> moved;
    std::erase_if(section.entries, [&](Entry& entry) {
        const std::string path = prefix + entry.name;
        const std::string key = path.starts_with("random.") ? path.substr(7) : path;
        const Position& at = entry.position;
        for (const RemovedKey& removed : kRemoved) {
            if (matches(removed.path, flat_path(key))) {
                const bool ignored = has_no_effect(removed, entry.value);
                (ignored ? ignored_ : problems)
                    .push_back(
                        {at.file, at.line, path,
                         ignored ? "belongs to an earlier version and is ignored" : "was removed",
                         ignored ? "remove it" : std::string(removed.remedy)});
                return true;
            }
        }
        if (is_table(key)) {
            rename(entry.value, path + ".", problems);
        }
        if (current_path(path) == path) {
            return false;
        }
        moved.push_back(std::move(entry));
        return true;
    });
    for (Entry& entry : moved) {
        const std::string path = prefix + entry.name, current = renamed(path, entry.position);
        Entry* target =
            entry_at(section, split(current.substr(prefix.size()), '.'), entry.position);
        if (target == nullptr) {
            problems.push_back({entry.position.file, entry.position.line, path,
                                fmt::format("is also given as {}", current), "remove one of them"});
        } else {
            target->value = std::move(entry.value);
        }
    }
}

void FormerKeys::replace(Value& document, Problems& problems) {
    for (Entry& section : document.entries) {
        if (section.name != "random") {
            rename(section.value, section.name + ".", problems);
            continue;
        }
        for (Entry& inner : section.value.entries) {
            rename(inner.value, "random." + inner.name + ".", problems);
        }
    }
    // Lists of keys.
    const auto rename_texts = [&](Value& table, std::string_view name) {
        if (Entry* list = find_in(table.entries, name, &Entry::name)) {
            for (Value& element : list->value.elements) {
                element.text = renamed(element.text, element.position);
            }
        }
    };
    for (Entry& section : document.entries) {
        if (section.name == "detection") {
            rename_texts(section.value, "uncertain_inputs");
        }
        if (Entry* pairs = find_in(section.value.entries, "correlations", &Entry::name)) {
            for (Value& pair : pairs->value.elements) {
                rename_texts(pair, "between");
            }
        }
    }
}

std::string FormerKeys::replace(const std::string& assignment) {
    const std::size_t end = assignment.find_first_of("= \t");
    return renamed(assignment.substr(0, end), {std::string(kOverrideFile), 0}) +
           (end == std::string::npos ? "" : assignment.substr(end));
}

Problems FormerKeys::notices() const {
    Problems all = ignored_;
    if (!renamed_.empty()) {
        const Use& first = renamed_.front();
        const std::size_t dot = first.current.rfind('.');
        all.push_back(
            {first.position.file, first.position.line, first.path,
             "is the spelling of an earlier version",
             fmt::format(
                 "write {} in [{}]{}", first.current.substr(dot + 1), first.current.substr(0, dot),
                 renamed_.size() == 1
                     ? ""
                     : fmt::format(", and {} more keys in the same way", renamed_.size() - 1))});
    }
    return all;
}

}  // namespace gearpod::mc
