// resolved_text(): writes a study as TOML.
#include <fmt/format.h>

#include <charconv>
#include <cmath>

#include "features/feature.hpp"
#include "mc/study/reading/parts.hpp"
#include "mc/study/schema/schema.hpp"

namespace gearpod::mc {
namespace {

// Shortest decimal number in the file's unit that converts back to exactly `si`.
std::string value_text(double si, double to_si) {
    if (si == 0.0) {
        return "0";  // without the sign: "-0" would be read as an integer and lose it
    }
    const double near = si / to_si;
    for (const int digits : {15, 16, 17}) {
        const std::string text = fmt::format("{:.{}g}", near, digits);
        double rounded = near;
        std::from_chars(text.data(), text.data() + text.size(), rounded);
        if (rounded * to_si == si) {
            return fmt::format("{}", rounded);
        }
    }
    for (const double neighbour :
         {std::nextafter(near, -HUGE_VAL), std::nextafter(near, HUGE_VAL)}) {
        if (neighbour * to_si == si) {
            return fmt::format("{}", neighbour);
        }
    }
    return fmt::format("{}", near);
}

// Value of one key as TOML; "" if it is not given.
class ValueText {
  public:
    ValueText(const Study& study, const Key& key) : study_(study), key_(key) {}

    std::string operator()(const NumberAccess& access) const {
        const auto value = access.get(study_);
        return value ? value_text(*value, key_.unit.to_si) : "";
    }
    std::string operator()(const IntegerAccess& access) const {
        const auto value = access.get(study_);
        return value ? fmt::format("{}", *value) : "";
    }
    std::string operator()(const BooleanAccess& access) const {
        const auto value = access.get(study_);
        return value ? fmt::format("{}", *value) : "";
    }
    std::string operator()(const ChoiceAccess&) const {
        const std::string_view text = choice_text(study_, key_.section, key_.name);
        return text.empty() ? "" : quoted_text(std::string(text));
    }
    std::string operator()(const NumbersAccess& access) const {
        std::vector<std::string> texts;
        for (const double value : access.get(study_)) {
            texts.push_back(value_text(value, key_.unit.to_si));
        }
        return in_brackets(texts);
    }
    std::string operator()(const TextsAccess& access) const {
        std::vector<std::string> texts;
        for (const std::string& value : access.get(study_)) {
            texts.push_back(quoted_text(value));
        }
        return in_brackets(texts);
    }

    // One line per table if tables have many fields.
    std::string operator()(const TablesAccess& access) const {
        constexpr std::size_t kMostFields = 4;
        const std::vector<std::string> texts = access.texts(study_);
        if (texts.empty() || access.fields.size() <= kMostFields) {
            return in_brackets(texts);
        }
        return fmt::format("[\n    {},\n]", fmt::join(texts, ",\n    "));
    }

    // One line per feature, so that differences of studies show the feature.
    std::string operator()(const PythonAccess& access) const {
        std::string text;
        for (const PythonFeature& one : access.get(study_)) {
            const features::Feature& feature = *one.feature;
            const auto pair = [](const char* name, std::string_view value) {
                return fmt::format("{} = {}", name, quoted_text(std::string(value)));
            };
            std::string modules;
            for (const std::string& module : one.hashes.modules) {
                modules += (modules.empty() ? "modules = [" : ", ") + quoted_text(module);
            }
            text += fmt::format(
                "    {{ {}, {}, {}, {}{}{}, {}, {}, {}, {} }},\n", pair("name", feature.name),
                pair("file", one.file), pair("sha256", one.hashes.sha256),
                modules.empty() ? "" : modules + "], ",
                feature.needs.has<features::SensorSamples>() ? "" : pair("samples", "no") + ", ",
                pair("title", feature.title), pair("unit", feature.unit),
                pair("alarm", feature.alarm == features::AlarmSide::high ? "high" : "low"),
                pair("uses", uses_text(feature)), pair("doc", feature.doc));
        }
        return text.empty() ? "" : fmt::format("[\n{}]", text);
    }

  private:
    static std::string in_brackets(const std::vector<std::string>& texts) {
        return texts.empty() ? "" : fmt::format("[{}]", fmt::join(texts, ", "));
    }

    const Study& study_;
    const Key& key_;
};

std::string table_text(const Study& study, const KeyTable& table) {
    std::string text;
    for (const Key* key : table.keys) {
        if (key->presence(study).need != Need::forbidden) {
            const std::string value = std::visit(ValueText(study, *key), key->access);
            text += value.empty() ? "" : fmt::format("{} = {}\n", key->label(), value);
        }
    }
    return text;
}

std::string random_text(const Study& study) {
    std::vector<std::string> pairs;
    for (const Correlation& one : study.correlations) {
        pairs.push_back(fmt::format("{{ between = [\"{}\", \"{}\"], rank = {} }}", one.first,
                                    one.second, one.rank));
    }
    std::string text =
        pairs.empty() ? "" : fmt::format("correlations = [{}]\n", fmt::join(pairs, ", "));
    for (const RandomInput& input : study.random) {
        text += fmt::format("{} = {}\n", input.key, input.distribution.toml());
    }
    return text;
}

}  // namespace

std::string resolved_text(const Study& study) {
    std::string text =
        study.title.empty() ? "" : fmt::format("title = {}\n\n", quoted_text(study.title));
    std::string gap;
    for (const KeyTable& table : key_tables()) {
        const std::string body =
            table.name == "random" ? random_text(study) : table_text(study, table);
        if (!body.empty()) {
            text += fmt::format("{}[{}]\n{}", gap, table.name, body);
            gap = "\n";
        }
    }
    return text;
}

}  // namespace gearpod::mc
