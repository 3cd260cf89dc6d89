#include <fmt/format.h>

#include <cmath>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "mc/study/schema/schema.hpp"
#include "mc/study/study.hpp"

namespace gearpod::mc {
namespace {

using OrderedJson = nlohmann::ordered_json;

// A value of the file's unit without the rounding error of the conversion from SI.
double rounded(double value) {
    return std::stod(fmt::format("{:.12g}", value));
}

// Studies that give nothing but the kind of gearbox.
struct EmptyStudies {
    Study planetary, fixed_shaft;

    EmptyStudies() { fixed_shaft.gearbox.kind = GearboxKind::fixed_shaft; }
};

// Type, allowed values and default of a key, written into `json`. The default is the value in a
// study that does not give the key; there is none where the program derives the value.
class ValueForm {
  public:
    ValueForm(const Key& key, const Study& defaults, OrderedJson& json)
        : key_(key), defaults_(defaults), json_(json) {}

    void operator()(const NumberAccess& access) const {
        json_["type"] = "number";
        const std::optional<double> value = access.get(defaults_);
        if (value && std::isfinite(*value)) {
            add_default(rounded(*value / key_.unit.to_si));
        }
    }
    void operator()(const IntegerAccess& access) const {
        json_["type"] = "integer";
        if (const std::optional<std::int64_t> value = access.get(defaults_)) {
            add_default(*value);
        }
    }
    void operator()(const BooleanAccess& access) const {
        json_["type"] = "boolean";
        if (const std::optional<bool> value = access.get(defaults_)) {
            json_["default"] = *value;
        }
    }
    void operator()(const ChoiceAccess& access) const {
        json_["type"] = "choice";
        OrderedJson choices = OrderedJson::array();
        const std::optional<int> value = access.get(defaults_);
        for (const ChoiceName& choice : access.names) {
            choices.push_back(std::string(choice.text));
            if (value == choice.value) {
                json_["default"] = std::string(choice.text);
            }
        }
        json_["choices"] = std::move(choices);
    }
    void operator()(const NumbersAccess& access) const {
        json_["type"] = "numbers";
        json_["ascending"] = access.ascending;
        OrderedJson values = OrderedJson::array();
        for (const double value : access.get(defaults_)) {
            values.push_back(rounded(value / key_.unit.to_si));
        }
        if (!values.empty()) {
            json_["default"] = std::move(values);
        }
    }
    void operator()(const TextsAccess& access) const {
        json_["type"] = "texts";
        const std::vector<std::string> values = access.get(defaults_);
        if (!values.empty()) {
            json_["default"] = values;
        }
    }
    void operator()(const TablesAccess& access) const {
        json_["type"] = "tables";
        for (const TableField& field : access.fields) {
            OrderedJson column{{"name", std::string(field.name)},
                               {"type", kFieldKinds[static_cast<std::size_t>(field.kind)]},
                               {"required", field.required}};
            for (const ChoiceName& choice : field.choices) {
                column["choices"].push_back(std::string(choice.text));
            }
            json_["fields"].push_back(std::move(column));
        }
    }
    void operator()(const PythonAccess&) const { json_["type"] = "python"; }

  private:
    static constexpr const char* kFieldKinds[] = {"number", "integer", "text", "numbers", "word"};

    // A number outside the key's range stands for "not given".
    template <class Value>
    void add_default(Value value) const {
        if (key_.range.contains(static_cast<double>(value))) {
            json_["default"] = value;
        }
    }

    const Key& key_;
    const Study& defaults_;
    OrderedJson& json_;
};

// Adds whether the key must be given, and the condition under which it may or must be.
void add_presence(const Key& key, const EmptyStudies& empty, OrderedJson& json) {
    const Presence planetary = key.presence(empty.planetary);
    const Presence fixed_shaft = key.presence(empty.fixed_shaft);
    const bool required = planetary.need == Need::required || fixed_shaft.need == Need::required;
    if (required) {
        json.erase("default");
    }
    json["required"] = required;
    json["condition"] = planetary.why.empty() ? fixed_shaft.why : planetary.why;
}

OrderedJson bound(double value) {
    return std::isfinite(value) ? OrderedJson(value) : OrderedJson(nullptr);
}

}  // namespace

OrderedJson key_json(const Key& key) {
    static const EmptyStudies empty;
    OrderedJson json = OrderedJson::object();
    json["section"] = std::string(key.section);
    json["name"] = std::string(key.name);
    json["unit"] = std::string(key.unit.name);
    std::visit(ValueForm(key, empty.planetary, json), key.access);
    add_presence(key, empty, json);
    json["low"] = bound(key.range.low);
    json["high"] = bound(key.range.high);
    json["low_open"] = key.range.low_open;
    json["high_open"] = key.range.high_open;
    json["range"] = key.range.text();
    json["random"] = key.may_be_random();
    json["meaning"] = std::string(key.doc);
    return json;
}

}  // namespace gearpod::mc
