// Distributions of random inputs. Each is a short struct in distributions/, registered in one line
// of distribution.cpp.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "mc/input/problems.hpp"
#include "mc/random/philox.hpp"
#include "mc/study/distributions/support.hpp"

namespace gearpod::mc {

struct Value;             // mc/input/document.hpp
struct DistributionKind;  // distribution.cpp

// An immutable distribution; copies share it. Values are in the unit of the study file's key.
class Distribution {
  public:
    std::string_view name() const;
    double median() const;
    Support support() const;
    // The values in turn of `levels` and `grid`, the value of `constant`; empty if continuous.
    std::vector<double> levels() const;
    // One value. `levels` and `grid` give value `turn` mod count and use no randomness; for all
    // others `turn` means nothing.
    double draw(Philox& engine, std::uint64_t turn) const;
    // Whether it has quantile(): all that neither take values in turn nor are drawn in rows.
    bool has_quantile() const;
    // The value that a share of the draws, 0 < share < 1, is not above.
    double quantile(double share) const;
    // Values that are drawn in rows: the group whose inputs draw the same place of their lists, 0
    // if there is none, and how many places there are.
    struct Rows {
        int group = 0;
        std::size_t count = 0;
    };
    Rows rows() const;
    // Whether every record of a gearbox draws it (per = "record"), else the gearbox.
    bool per_record() const;
    // As an inline TOML table, e.g. { distribution = "uniform", low = 0, high = 3 }.
    std::string toml() const;
    bool operator==(const Distribution& other) const;

    // From its TOML table. Problems are appended under `key`; then there is no distribution.
    static std::optional<Distribution> read(const Value& table, const std::string& key,
                                            Problems& problems);

  private:
    explicit Distribution(std::shared_ptr<const DistributionKind> kind);
    std::shared_ptr<const DistributionKind> kind_;
};

// Names of all distributions, for help and spelling.
std::vector<std::string_view> distribution_names();

}  // namespace gearpod::mc
