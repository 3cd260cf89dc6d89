#include "mc/study/reading/unknown_keys.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "mc/input/spelling.hpp"
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
        if (key.name == name) {
            return {nullptr, fmt::format("it belongs in [{}]", key.section)};
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

}  // namespace

void reject_unknown_key(StudyDraft& draft, const std::string& prefix, const std::string& section,
                        const Entry& entry) {
    const Guess guess = guess_key(section, entry.name);
    draft.reject(entry.position, prefix + section + "." + entry.name, "unknown key", guess.words);
    if (guess.key != nullptr) {
        draft.bad.insert(guess.key->path());
    }
}

}  // namespace gearpod::mc
