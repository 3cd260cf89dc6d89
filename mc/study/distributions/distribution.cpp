#include "mc/study/distributions/distribution.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <tuple>
#include <utility>
#include <variant>

#include "machine/no_value.hpp"
#include "mc/files/input/document.hpp"
#include "mc/files/input/spelling.hpp"
#include "mc/study/distributions/laws.hpp"

namespace gearpod::mc {

// All registered distributions. A new one is added here.
using AnyLaw = std::variant<Constant, Uniform, Normal, Lognormal, TruncatedNormal, Triangular,
                            Weibull, Beta, Discrete, Empirical, Levels, Grid>;

struct DistributionKind {
    AnyLaw law;
    DrawnPer per = DrawnPer::gearbox;
};

namespace {

constexpr std::string_view kPer = "per";

// Calls `visit` once for each registered distribution, with a default-constructed object.
template <class Visit, std::size_t... I>
void for_each_law(Visit visit, std::index_sequence<I...>) {
    (visit(std::variant_alternative_t<I, AnyLaw>{}), ...);
}
template <class Visit>
void for_each_law(Visit visit) {
    for_each_law(visit, std::make_index_sequence<std::variant_size_v<AnyLaw>>{});
}

// Reads the fields of one distribution from its table.
class FieldReader {
  public:
    FieldReader(const Value& table, const std::string& key, Problems& problems)
        : table_(table), key_(key), problems_(problems) {}

    template <class Law>
    bool read(Law& law) {
        bool good = reject_unknown<Law>();
        // A misspelt parameter is not reported as missing as well.
        const bool spelled = good;
        std::apply(
            [&](const auto&... field) { ((good = read_field(law, field, spelled) && good), ...); },
            Law::fields());
        // Contradictions between parameters. A bad parameter is NaN, so every comparison with it is
        // false and none is reported.
        if (!law.problem().empty()) {
            good = add(table_.position, "", law.problem(), "");
        }
        return good;
    }

  private:
    template <class Law>
    bool reject_unknown() {
        std::vector<std::string_view> known;
        std::apply([&](const auto&... field) { (known.push_back(field.name), ...); },
                   Law::fields());
        bool good = true;
        for (const Entry& entry : table_.entries) {
            if (entry.name != "distribution" && entry.name != kPer &&
                std::find(known.begin(), known.end(), entry.name) == known.end()) {
                good = add(entry.position, entry.name,
                           fmt::format("unknown parameter of {}", Law::kName),
                           suggest(entry.name, known));
            }
        }
        return good;
    }

    template <class Law, class Type>
    bool read_field(Law& law, const Field<Law, Type>& field, bool report_missing) {
        Type& target = law.*(field.member);
        const Entry* entry = table_.find(field.name);
        if (entry != nullptr) {
            return convert(*entry, field.range, target);
        }
        if (field.optional) {
            return true;
        }
        make_bad(target);
        return report_missing ? add(table_.position, std::string(field.name), "missing",
                                    fmt::format("{} needs it", Law::kName))
                              : false;
    }

    static void make_bad(double& target) { target = kNan; }
    template <class Type>
    static void make_bad(Type&) {}

    bool convert(const Entry& entry, const Range& range, double& target) {
        target = entry.value.number;
        const bool good = check_number(entry, entry.value, range);
        if (!good) {
            make_bad(target);
        }
        return good;
    }

    // Precondition: the range fits into an int.
    bool convert(const Entry& entry, const Range& range, int& target) {
        const Value& value = entry.value;
        if (value.kind != Value::Kind::integer) {
            return add(entry.position, entry.name,
                       fmt::format("must be an integer, but is {}", value.shown()), range.hint());
        }
        if (!range.contains(value.number)) {
            return add(entry.position, entry.name,
                       fmt::format("must be an integer {}, but is {}", range.text(), value.integer),
                       "");
        }
        target = static_cast<int>(value.integer);
        return true;
    }

    bool convert(const Entry& entry, const Range& range, std::vector<double>& target) {
        if (entry.value.kind != Value::Kind::array) {
            return add(entry.position, entry.name,
                       fmt::format("must be a list of numbers, but is {}", entry.value.shown()),
                       "write values = [0, 1, 2]");
        }
        if (entry.value.elements.empty()) {
            return add(entry.position, entry.name, "has no values", "give at least one");
        }
        if (entry.value.elements.size() > kMostElements) {
            return add(entry.position, entry.name,
                       fmt::format("has {} values, but at most {} are allowed",
                                   entry.value.elements.size(), kMostElements),
                       "give fewer");
        }
        bool good = true;
        for (const Value& element : entry.value.elements) {
            good = check_number(entry, element, range) && good;
            target.push_back(element.number);
        }
        return good;
    }

    bool check_number(const Entry& entry, const Value& value, const Range& range) {
        std::string what = number_problem(value);
        if (what.empty() && !range.contains(value.number)) {
            what = fmt::format("must be {}, but is {}", range.text(), value.number);
        }
        return what.empty() || add(entry.position, entry.name, std::move(what), "");
    }

    bool add(const Position& position, const std::string& name, std::string what,
             std::string remedy) {
        problems_.push_back({position.file, position.line, name.empty() ? key_ : key_ + "." + name,
                             std::move(what), std::move(remedy)});
        return false;
    }

    const Value& table_;
    const std::string& key_;
    Problems& problems_;
};

constexpr std::pair<std::string_view, DrawnPer> kPerNames[] = {
    {"gearbox", DrawnPer::gearbox}, {"assembly", DrawnPer::assembly}, {"record", DrawnPer::record}};

// Value of `per`, by default that of the gearbox; empty after a problem.
std::optional<DrawnPer> read_per(const Value& table, const std::string& key, Problems& problems) {
    const Entry* per = table.find(kPer);
    if (per == nullptr) {
        return DrawnPer::gearbox;
    }
    for (const auto& [text, value] : kPerNames) {
        if (per->value.kind == Value::Kind::text && per->value.text == text) {
            return value;
        }
    }
    problems.push_back({per->position.file, per->position.line, fmt::format("{}.{}", key, kPer),
                        "must be \"record\", \"assembly\" or \"gearbox\"",
                        "write per = \"record\" for a new value in every record, per = "
                        "\"assembly\" for one in each assembly (that of the baseline and the "
                        "tested one); per = \"gearbox\" is the default"});
    return std::nullopt;
}

const char* kind_text(double) {
    return "number";
}
const char* kind_text(int) {
    return "integer";
}
const char* kind_text(const std::vector<double>&) {
    return "list of numbers";
}

std::string text_of(double value) {
    return fmt::format("{}", value);
}
std::string text_of(int value) {
    return fmt::format("{}", value);
}
std::string text_of(const std::vector<double>& values) {
    return fmt::format("[{}]", fmt::join(values, ", "));
}

}  // namespace

Distribution::Distribution(std::shared_ptr<const DistributionKind> kind, double to_si)
    : kind_(std::move(kind)), to_si_(to_si) {}

std::string_view Distribution::name() const {
    return std::visit([](const auto& law) { return law.kName; }, kind_->law);
}

double Distribution::median() const {
    return to_si_ * std::visit([](const auto& law) { return law.median(); }, kind_->law);
}

Support Distribution::support() const {
    Support support = std::visit([](const auto& law) { return law.support(); }, kind_->law);
    support.low *= to_si_;
    support.high *= to_si_;
    return support;
}

std::vector<double> Distribution::levels() const {
    std::vector<double> levels =
        std::visit([](const auto& law) { return law.levels(); }, kind_->law);
    for (double& level : levels) {
        level *= to_si_;
    }
    return levels;
}

double Distribution::draw(Philox& engine, std::uint64_t level_index) const {
    return to_si_ *
           std::visit([&](const auto& law) { return law.draw(engine, level_index); }, kind_->law);
}

bool Distribution::has_quantile() const {
    return rows().group == 0 && std::visit(
                                    [](const auto& law) {
                                        return requires {
                                            law.quantile(0.5);
                                        };
                                    },
                                    kind_->law);
}

double Distribution::quantile(double share) const {
    return to_si_ * std::visit(
                        [&](const auto& law) {
                            if constexpr (requires { law.quantile(share); }) {
                                return law.quantile(share);
                            } else {
                                return law.median();
                            }
                        },
                        kind_->law);
}

Distribution::Rows Distribution::rows() const {
    return std::visit(
        [](const auto& law) -> Rows {
            if constexpr (requires { law.rows; }) {
                return {law.rows, law.values.size()};
            } else {
                return {};
            }
        },
        kind_->law);
}

DrawnPer Distribution::per() const {
    return kind_->per;
}

std::string Distribution::toml() const {
    const std::string per =
        kind_->per == DrawnPer::gearbox
            ? ""
            : fmt::format(", {} = \"{}\"", kPer, kPerNames[static_cast<int>(kind_->per)].first);
    return std::visit(
        [&](const auto& law) {
            std::string text = fmt::format("{{ distribution = \"{}\"", law.kName);
            std::apply(
                [&](const auto&... field) {
                    ((text += fmt::format(", {} = {}", field.name, text_of(law.*(field.member)))),
                     ...);
                },
                law.fields());
            return text + per + " }";
        },
        kind_->law);
}

bool Distribution::operator==(const Distribution& other) const {
    return kind_->law == other.kind_->law && kind_->per == other.kind_->per &&
           to_si_ == other.to_si_;
}

std::optional<Distribution> Distribution::read(const Value& table, const std::string& key,
                                               Problems& problems, double to_si) {
    const std::string choices = fmt::format("one of {}", fmt::join(distribution_names(), ", "));
    const Entry* kind = table.kind == Value::Kind::table ? table.find("distribution") : nullptr;
    if (kind == nullptr) {
        problems.push_back({table.position.file, table.position.line, key,
                            table.kind == Value::Kind::table
                                ? "has no distribution"
                                : fmt::format("must be a table, but is {}", table.shown()),
                            "write { distribution = \"...\", ... } with " + choices});
        return std::nullopt;
    }
    if (kind->value.kind != Value::Kind::text) {
        problems.push_back({kind->position.file, kind->position.line, key + ".distribution",
                            fmt::format("must be a string, but is {}", kind->value.shown()),
                            choices});
        return std::nullopt;
    }
    std::optional<Distribution> distribution;
    bool known = false;
    for_each_law([&](auto law) {
        if (law.kName == kind->value.text) {
            known = true;
            const std::optional<DrawnPer> drawn_per = read_per(table, key, problems);
            if (FieldReader(table, key, problems).read(law) && drawn_per) {
                distribution = Distribution(std::make_shared<const DistributionKind>(
                                                DistributionKind{std::move(law), *drawn_per}),
                                            to_si);
            }
        }
    });
    if (!known) {
        problems.push_back({kind->position.file, kind->position.line, key,
                            fmt::format("unknown distribution \"{}\"", kind->value.text),
                            suggest(kind->value.text, distribution_names())});
    }
    return distribution;
}

std::vector<std::string_view> distribution_names() {
    std::vector<std::string_view> names;
    for_each_law([&](const auto& law) { names.push_back(law.kName); });
    return names;
}

std::vector<DistributionHelp> distribution_help() {
    std::vector<DistributionHelp> all;
    for_each_law([&](const auto& law) {
        std::string parameters;
        const auto add = [&](const auto& field) {
            const std::string range = field.range.text();
            parameters += fmt::format("{}{} ({}{}{}{})", parameters.empty() ? "" : ", ", field.name,
                                      kind_text(law.*(field.member)), range.empty() ? "" : " ",
                                      range, field.optional ? ", optional" : "");
        };
        std::apply([&](const auto&... field) { (add(field), ...); }, law.fields());
        if constexpr (requires { law.kOtherwise; }) {
            parameters += fmt::format("; {}", law.kOtherwise);
        }
        all.push_back({std::string(law.kName), parameters});
    });
    return all;
}

}  // namespace gearpod::mc
