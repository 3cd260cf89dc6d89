#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "mc/input/spelling.hpp"
#include "mc/study/copula.hpp"
#include "mc/study/reading/parts.hpp"

namespace gearpod::mc {
namespace {

constexpr const char* kPair =
    "write { between = [\"section.key\", \"section.key\"], rank = 0.6 } for each pair";

class CorrelationReader {
  public:
    CorrelationReader(StudyDraft& draft, const Position& position, std::string which)
        : draft_(draft), position_(position), which_(std::move(which)) {}

    void read(const Value& table) {
        if (table.kind != Value::Kind::table) {
            return reject(fmt::format("must be a table, but is {}", table.shown()), kPair);
        }
        for (const Entry& entry : table.entries) {
            if (entry.name != "between" && entry.name != "rank") {
                reject("unknown key " + entry.name, suggest(entry.name, {"between", "rank"}));
            }
        }
        Correlation pair;
        read_inputs(table.find("between"), pair);
        read_rank(table.find("rank"), pair);
        if (good_) {
            add(pair);
        }
    }

    bool good() const { return good_; }

  private:
    void reject(const std::string& what, std::string remedy) {
        draft_.reject(position_, "random.correlations", which_ + ": " + what, std::move(remedy));
        good_ = false;
    }

    void read_inputs(const Entry* between, Correlation& pair) {
        const bool two = between != nullptr && between->value.elements.size() == 2 &&
                         std::ranges::all_of(between->value.elements, [](const Value& key) {
                             return key.kind == Value::Kind::text;
                         });
        if (!two) {
            return reject("between must list two keys of [random]", kPair);
        }
        pair.first = between->value.elements[0].text;
        pair.second = between->value.elements[1].text;
        check_input(pair.first);
        check_input(pair.second);
        if (good_ && pair.first == pair.second) {
            reject("both are " + pair.first, "name two inputs");
        }
    }

    void check_input(const std::string& key) {
        const RandomInput* input = draft_.study.find_random(key);
        if (input == nullptr) {
            std::vector<std::string_view> known;
            for (const RandomInput& other : draft_.study.random) {
                known.push_back(other.key);
            }
            good_ = false;  // a random input with a problem has its own message
            if (!draft_.bad.contains("random." + key)) {
                reject(key + " is not random", known.empty() ? "" : suggest(key, known));
            }
        } else if (key.starts_with("fault.")) {
            reject(key + " is the fault size, which cannot be correlated with other inputs",
                   "correlate other inputs");
        } else if (input->distribution.per() != DrawnPer::gearbox) {
            reject(key +
                       " varies between the records of a gearbox (per), so it cannot be correlated "
                       "with "
                       "inputs of the gearbox",
                   "correlate other inputs");
        } else if (!input->distribution.has_quantile()) {
            reject(input->distribution.rows().group > 0
                       ? key + " is already sampled by row together with other inputs"
                       : fmt::format("{} takes its values in turn ({})", key,
                                     input->distribution.name()),
                   "correlate other inputs");
        }
    }

    void read_rank(const Entry* rank, Correlation& pair) {
        const bool number = rank != nullptr && (rank->value.kind == Value::Kind::number ||
                                                rank->value.kind == Value::Kind::integer);
        if (!number || !(std::abs(rank->value.number) < 1.0)) {
            return reject("rank must be a number > -1 and < 1, the rank correlation", kPair);
        }
        pair.rank = rank->value.number;
    }

    void add(const Correlation& pair) {
        const auto keys = [](const Correlation& one) { return std::minmax(one.first, one.second); };
        auto& all = draft_.study.correlations;
        const bool known = std::ranges::any_of(
            all, [&](const Correlation& other) { return keys(other) == keys(pair); });
        if (known) {
            return reject(fmt::format("{} and {} are correlated already", pair.first, pair.second),
                          "give a pair once");
        }
        all.push_back(pair);
    }

    StudyDraft& draft_;
    Position position_;
    std::string which_;
    bool good_ = true;
};

}  // namespace

void read_correlations(StudyDraft& draft, const Entry& list) {
    if (list.value.kind != Value::Kind::array) {
        return draft.reject(list.position, "random.correlations",
                            fmt::format("must be a list of pairs, but is {}", list.value.shown()),
                            kPair);
    }
    bool good = true;
    for (std::size_t i = 0; i < list.value.elements.size(); ++i) {
        CorrelationReader reader(draft, list.position, fmt::format("pair {}", i + 1));
        reader.read(list.value.elements[i]);
        good = reader.good() && good;
    }
    if (good && !Copula(draft.study).exists()) {
        draft.reject(list.position, "random.correlations",
                     "no random inputs can have all these correlations (their matrix, with 0 for "
                     "pairs that are not listed, is not positive definite)",
                     "use smaller correlations, or list the missing pairs");
    }
}

}  // namespace gearpod::mc
