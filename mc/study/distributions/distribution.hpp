// Probability distributions of random inputs. Each one is a short struct in distributions/,
// registered in one line of distribution.cpp.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "mc/files/input/problems.hpp"
#include "mc/study/distributions/range.hpp"
#include "mc/study/random/philox.hpp"

namespace gearpod::mc {

struct Value;             // mc/files/input/document.hpp
struct DistributionKind;  // distribution.cpp

// Owner of one value of a random input: a gearbox, each of its assemblies (the one in which the
// baseline was recorded and the one that is tested), or each record.
enum class DrawnPer { gearbox, assembly, record };

// Immutable distribution; copies share their state. Values are in SI: to_si times those of the
// study file.
class Distribution {
  public:
    std::string_view name() const;
    double median() const;
    Support support() const;
    // Values of `levels` and `grid` in their order, or the value of `constant`; empty otherwise.
    std::vector<double> levels() const;
    // Returns one value. `levels` and `grid` return value number `level_index` mod count and use no
    // randomness; all other distributions ignore `level_index`, the level index.
    double draw(Philox& engine, std::uint64_t level_index) const;
    // True if quantile() is defined: for all distributions that neither take their values in turn
    // nor are sampled in rows.
    bool has_quantile() const;
    // Quantile at probability `share`, 0 < share < 1.
    double quantile(double share) const;
    // Joint sampling of lists by row. Inputs of the same nonzero `group` use the same row of their
    // lists, which have `count` rows. Group 0: sampled independently.
    struct Rows {
        int group = 0;
        std::size_t count = 0;
    };
    Rows rows() const;
    DrawnPer per() const;
    // True if every record of a gearbox has its own value (per = "record").
    bool per_record() const { return per() == DrawnPer::record; }
    // The same distribution with its values as in the study file.
    Distribution in_unit_of_file() const { return Distribution(kind_, 1.0); }
    // Inline TOML table with values as in the study file, e.g. { distribution = "uniform", low = 0,
    // high = 3 }.
    std::string toml() const;
    bool operator==(const Distribution& other) const;

    // Reads a TOML table. Problems are appended under `key`; the result is then empty. `to_si`:
    // factor from its unit to SI.
    static std::optional<Distribution> read(const Value& table, const std::string& key,
                                            Problems& problems, double to_si = 1.0);

  private:
    Distribution(std::shared_ptr<const DistributionKind> kind, double to_si);
    std::shared_ptr<const DistributionKind> kind_;
    double to_si_;
};

// Names of all distributions, for help texts and spelling suggestions.
std::vector<std::string_view> distribution_names();

// Parameters of all distributions in their order, as text for help.
struct DistributionHelp {
    std::string name;
    std::string parameters;  // "low (number), count (integer >= 1), values (list of numbers)"
};
std::vector<DistributionHelp> distribution_help();

}  // namespace gearpod::mc
