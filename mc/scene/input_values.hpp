// Values of a study's numbers for one gearbox: drawn where they are random, else nominal.
#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "mc/study/keys/key.hpp"
#include "mc/study/study.hpp"

namespace gearpod::mc {

class InputValues {
  public:
    // The study must outlive the object.
    explicit InputValues(const Study& study) : study_(study) {}

    const Study& study() const { return study_; }

    // Replaces the number of study() that is stored at `place` (NumberAccess::place), SI.
    void set(const void* place, double value) { values_.emplace_back(place, value); }

    // Value of a number, which must be a member of study(), not a copy.
    double of(const double& number) const {
        const double* own = find(&number);
        return own != nullptr ? *own : number;
    }
    std::optional<double> of(const std::optional<double>& number) const {
        const double* own = find(&number);
        return own != nullptr ? *own : number;
    }
    double of(const double&&) const = delete;
    std::optional<double> of(const std::optional<double>&&) const = delete;
    // Value of a number that is named by its key; empty if it is not given.
    std::optional<double> of(const NumberAccess& access) const {
        const double* own = find(access.place(study_));
        return own != nullptr ? *own : access.get(study_);
    }

  private:
    // The value that was set last, or null.
    const double* find(const void* place) const {
        for (auto value = values_.rbegin(); value != values_.rend(); ++value) {
            if (value->first == place) {
                return &value->second;
            }
        }
        return nullptr;
    }

    const Study& study_;
    std::vector<std::pair<const void*, double>> values_;
};

}  // namespace gearpod::mc
