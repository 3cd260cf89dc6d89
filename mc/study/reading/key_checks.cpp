#include <fmt/format.h>

#include <algorithm>

#include "mc/files/input/spelling.hpp"
#include "mc/study/gears.hpp"
#include "mc/study/reading/parts.hpp"
#include "mc/study/schema/schema.hpp"

namespace gearpod::mc {
namespace {

struct Guess {
    const Key* key = nullptr;  // key that was probably meant
    std::string words;
};

Guess guess_by_unit(const std::string& section, const std::string& name) {
    for (const Key& key : schema()) {
        if (key.section != section || key.unit.suffix.empty()) {
            continue;
        }
        if (key.stem() == name) {
            return {&key, fmt::format("did you mean {}? (unit missing)", key.name)};
        }
        if (key.stem() == without_unit(name)) {
            return {&key,
                    fmt::format("did you mean {}? (its unit is {})", key.name, key.unit.name)};
        }
    }
    return {};
}

// Key with a similar name apart from the unit, or nullptr.
const Key* near_without_unit(const std::string& section, const std::string& name) {
    std::vector<std::string_view> stems;
    for (const Key& key : schema()) {
        if (key.section == section && !key.unit.suffix.empty()) {
            stems.push_back(key.stem());
        }
    }
    const std::string_view best = nearest(name, stems);
    const int allowed = std::max(1, static_cast<int>(best.size()) / 3);
    return !best.empty() && edit_distance(name, best) <= allowed
               ? guess_by_unit(section, std::string(best)).key
               : nullptr;
}

Guess guess_key(const std::string& section, const std::string& name) {
    if (Guess guess = guess_by_unit(section, name); guess.key != nullptr) {
        return guess;
    }
    std::vector<std::string_view> names;
    for (const Key& key : schema()) {
        if (key.label() == name) {
            return {nullptr, fmt::format("it belongs in [{}]", key.table())};
        }
        if (key.section == section) {
            names.push_back(key.name);
        }
    }
    const std::string words = suggest(name, names);
    if (words.starts_with("did you mean")) {
        return {find_key(section, nearest(name, names)), words};
    }
    if (const Key* key = near_without_unit(section, name)) {
        return {key, fmt::format("did you mean {}?", key->name)};
    }
    return {nullptr, words.empty()
                         ? fmt::format("`gearpod describe --keys {}` lists the keys", section)
                         : words};
}

constexpr const char* kSpeedKeys = "sun_speed_rpm or carrier_speed_rpm";

std::vector<std::string> given_of(const StudyDraft& draft, const std::vector<std::string>& paths) {
    std::vector<std::string> given;
    for (const std::string& path : paths) {
        if (draft.is_given(path)) {
            given.push_back(path);
        }
    }
    return given;
}

void reject_second(StudyDraft& draft, const std::vector<std::string>& given,
                   const std::string& rule) {
    if (given.size() > 1) {
        draft.reject(draft.position(given[1]), given[1],
                     fmt::format("conflicts with {} ({})", given[0], rule), "remove one of them");
    }
}

void check_exclusive_keys(StudyDraft& draft) {
    for (const Member member : kAllMembers) {
        reject_second(draft,
                      given_of(draft, {member_key(member, "inertia_kg_m2"),
                                       member_key(member, "inertia_over_r2_kg")}),
                      "both give the moment of inertia");
    }
    if (draft.study.gearbox.kind != GearboxKind::planetary || !draft.usable("gearbox.kind")) {
        return;
    }
    const auto speeds = given_of(draft, {"operation.sun_speed_rpm", "operation.carrier_speed_rpm"});
    reject_second(draft, speeds, "one speed determines all others");
    if (speeds.empty() && draft.usable("operation")) {
        draft.reject(draft.position("operation"), "operation", "no speed is given",
                     fmt::format("add {}", kSpeedKeys));
    }
}

// Reports all required keys of a missing section in one message.
void check_sections(StudyDraft& draft) {
    for (const std::string_view name : section_names()) {
        const std::string section(name);
        std::vector<std::string_view> required;
        for (const Key& key : schema()) {
            const bool needed = key.presence(draft.study).need == Need::required;
            if (key.section == name && needed && !draft.is_given(key.path())) {
                required.push_back(key.name);
            }
        }
        if (!draft.sections.contains(section) && draft.usable(section) && !required.empty()) {
            const bool needs_speed =
                section == "operation" && draft.study.gearbox.kind == GearboxKind::planetary;
            draft.reject(draft.position(section), section, "the section is missing",
                         fmt::format("add [{}] with {}{}", section, fmt::join(required, ", "),
                                     needs_speed ? fmt::format(" and {}", kSpeedKeys) : ""));
        }
    }
}

}  // namespace

void reject_unknown_key(StudyDraft& draft, const std::string& prefix, const std::string& section,
                        const Entry& entry) {
    const Guess guess = guess_key(section, entry.name);
    draft.reject(entry.position, prefix + section + "." + entry.name, "unknown key", guess.words);
    if (guess.key != nullptr) {
        draft.bad.insert(guess.key->path());
    }
}

void check_presence(StudyDraft& draft, const Key& key) {
    const Presence presence = key.presence(draft.study);
    const std::string path = key.path();
    if (!draft.usable(path)) {
        return;
    }
    for (const std::string_view governor : presence.governors) {
        if (!draft.usable(std::string(governor))) {
            return;
        }
    }
    const std::string because = presence.why.empty() ? "" : fmt::format(" ({})", presence.why);
    if (presence.need == Need::required && !draft.is_given(path)) {
        draft.reject(draft.position(path), path, "missing" + because,
                     fmt::format("add {} to [{}]: {}", key.label(), key.table(), key.doc));
    }
    if (presence.need == Need::forbidden && draft.is_given(path)) {
        draft.reject(draft.position(path), path, "is not allowed here" + because, "remove it");
    }
}

void check_presence(StudyDraft& draft) {
    check_sections(draft);
    for (const Key& key : schema()) {
        if (draft.usable(std::string(key.section))) {
            check_presence(draft, key);
        }
    }
    check_exclusive_keys(draft);
}

}  // namespace gearpod::mc
