// Real time histories of universal files as columns.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "mc/files/formats/common_sampling.hpp"
#include "mc/files/formats/uff_file.hpp"
#include "mc/files/input/terminal_text.hpp"
#include "mc/files/signal_file.hpp"
#include "mc/files/signal_units.hpp"

namespace gearpod::mc {
namespace {

constexpr int kUffUnknown = 0, kUffGeneral = 1, kUffTimeResponse = 1, kUffDisplacement = 8,
              kUffVelocity = 11, kUffAcceleration = 12, kUffTime = 17, kUffSpeed = 19;
constexpr const char* kUffTimes = "time";

bool is_unspecific(const UffAxis& axis) {
    return axis.type == kUffUnknown || axis.type == kUffGeneral;
}

// Reason why a function is not a real time history; "" if it is one.
std::string other_kind(const UffFunction& function) {
    const bool response = function.function_type == kUffTimeResponse;
    const bool over_time =
        function.abscissa.type == kUffTime || (response && is_unspecific(function.abscissa) &&
                                               unit_factor(Quantity::time, function.abscissa.unit));
    if (!response && function.function_type != 0) {
        return uff_function_kind(function.function_type);
    }
    if (!over_time) {
        return "function of " + uff_quantity(function.abscissa.type);
    }
    return function.complex ? "complex time response" : "";
}

// Unit of an acceleration in the file's units of length (dataset 164).
std::string acceleration_in_lengths(double per_metre) {
    constexpr std::pair<double, const char*> kLengths[] = {
        {1.0, "m"},  {100.0, "cm"},        {1000.0, "mm"},
        {1e6, "um"}, {1.0 / 0.0254, "in"}, {1.0 / 0.3048, "ft"}};
    for (const auto& [count, name] : kLengths) {
        if (std::abs(per_metre / count - 1.0) < 1e-4) {
            return fmt::format("{}/s^2", name);
        }
    }
    return fmt::format("1/{:g} of m/s^2, by dataset 164", per_metre);
}

// Unit of the ordinate. A text that is no unit names a quantity other than an acceleration, or a
// contradiction between the function's label and dataset 164.
std::string ordinate_unit(const UffFunction& function) {
    const UffAxis& ordinate = function.ordinate;
    const std::string& label = ordinate.unit;
    const auto lengths = function.lengths_per_metre;
    if (function.denominator.type != kUffUnknown || !function.denominator.unit.empty()) {
        return fmt::format("{} per {} by the function's denominator",
                           label.empty() ? uff_quantity(ordinate.type) : label,
                           function.denominator.unit.empty()
                               ? uff_quantity(function.denominator.type)
                               : function.denominator.unit);
    }
    const bool angular =
        !label.empty() &&
        ((ordinate.type == kUffDisplacement && unit_factor(Quantity::angle, label)) ||
         (ordinate.type == kUffVelocity && unit_factor(Quantity::speed, label)));
    if (angular || ordinate.type == kUffTime) {
        return label;
    }
    if (ordinate.type == kUffSpeed) {
        return label.empty() ? "rpm" : label;
    }
    if (!is_unspecific(ordinate) && ordinate.type != kUffAcceleration) {
        return fmt::format("{}{}, ordinate data type {}", uff_quantity(ordinate.type),
                           label.empty() ? "" : " in " + label, ordinate.type);
    }
    if (label.empty()) {
        const bool rotation = std::abs(function.response_direction) >= 4;
        if (ordinate.type == kUffAcceleration && rotation) {
            return "rad/s^2";
        }
        if (ordinate.type == kUffAcceleration && lengths) {
            return acceleration_in_lengths(*lengths);
        }
        return !lengths || *lengths == 1.0
                   ? ""
                   : fmt::format("not stated, with {:g} units of length per metre by dataset 164",
                                 *lengths);
    }
    const auto factor = unit_factor(Quantity::acceleration, label);
    // A unit of gravity is no product of the file's units: it agrees with SI only.
    const bool agrees = !factor || !lengths || std::abs(*factor * *lengths - 1.0) < 1e-4 ||
                        (*lengths == 1.0 && label.find('/') == std::string::npos);
    return agrees ? label
                  : fmt::format("{} by the function's label, but {} by dataset 164", label,
                                acceleration_in_lengths(*lengths));
}

// Rate of a step that was rounded in the file: the whole number of Hz that rounds to this step, if
// there is exactly one.
double unrounded_rate_Hz(double step_s, double rounding_s) {
    constexpr double kMargin = 1e-9;
    const double lowest = std::ceil((1.0 - kMargin) / (step_s + rounding_s));
    const double highest = std::floor((1.0 + kMargin) / (step_s - rounding_s));
    return rounding_s < step_s && lowest == highest ? lowest : 1.0 / step_s;
}

class SignalUff : public SignalFile {
  public:
    explicit SignalUff(const std::string& path) : path_(path), all_(read_uff(path)) {
        std::string others;
        for (std::size_t i = 0; i < all_.size(); ++i) {
            const std::string kind = other_kind(all_[i]);
            if (kind.empty()) {
                histories_.push_back(i);
            } else if (others.find(kind) == std::string::npos) {
                others += (others.empty() ? "" : ", ") + kind;
            }
        }
        if (histories_.empty()) {
            throw SignalError(fmt::format(
                "{}: contains no real time history; its functions are: {}", path_, others));
        }
        name_columns();
    }

    std::vector<std::string> names() const override {
        std::vector<std::string> names;
        for (const Column& column : columns_) {
            names.push_back(column.name);
        }
        if (has_times()) {
            names.emplace_back(kUffTimes);
        }
        return names;
    }

    // A history is found by its name, or by its title if there are several.
    std::string find(const ColumnChoice& choice) override {
        if (has(choice.name) || columns_.size() == 1) {
            return has(choice.name) ? choice.name : "";
        }
        std::vector<std::string> found;
        for (const Column& column : columns_) {
            if (!choice.name.empty() && all_[column.function].title == choice.name) {
                found.push_back(column.name);
            }
        }
        if (found.size() > 1 && choice.requested) {
            throw SignalError(fmt::format("{}: {} is the title of several functions: {}", path_,
                                          printable(choice.name), listed_text(found)));
        }
        return found.size() == 1 ? found.front() : "";
    }

    std::string contents() override {
        std::vector<std::string> texts;
        for (const Column& column : columns_) {
            const std::string& title = all_[column.function].title;
            texts.push_back(title.empty() || columns_.size() == 1
                                ? column.name
                                : fmt::format("{} ({})", column.name, title));
        }
        if (has_times()) {
            texts.emplace_back(kUffTimes);
        }
        return listed_text(texts);
    }

    std::vector<std::string> notes() override { return notes_; }

    std::vector<double> read(const std::string& name) override {
        if (name == kUffTimes) {
            return times();
        }
        const UffFunction& function = all_[of(name)];
        const double second = unit_of_abscissa(name, function);
        if (!function.unreadable.empty()) {
            throw SignalError(fmt::format("{}: column {}: {}", path_, name, function.unreadable));
        }
        if (!function.even || times_) {
            times_ = times_ ? times_ : of(name);
            if (function.even || sampling_.rate_Hz() ||
                all_[*times_].abscissae != function.abscissae) {
                throw SignalError(fmt::format(
                    "{}: column {} has other times than the first column in use", path_, name));
            }
            return function.values;
        }
        const double step_s = function.step * second;
        if (!(step_s > 0.0 && std::isfinite(1.0 / step_s))) {
            throw SignalError(
                fmt::format("{}: column {}: {:g} s is not a valid time step", path_, name, step_s));
        }
        count_ = function.values.size();
        const double rate = unrounded_rate_Hz(step_s, function.step_rounding * second);
        if (rate != 1.0 / step_s && !sampling_.rate_Hz()) {
            notes_.push_back(fmt::format(
                "the rate is {:.0f} Hz, which rounds to the time step {:g} s", rate, step_s));
        }
        sampling_.add(path_, name, rate, function.first * second);
        return function.values;
    }

    std::string unit(const std::string& name) override {
        if (name != kUffTimes) {
            return ordinate_unit(all_[of(name)]);
        }
        return sampling_.rate_Hz() ? "s" : all_[times_.value_or(first_uneven())].abscissa.unit;
    }

    std::optional<double> sampling_Hz() override {
        if (!times_ && !sampling_.rate_Hz() && all_[histories_.front()].even) {
            read(columns_.front().name);
        }
        return sampling_.rate_Hz();
    }

  private:
    struct Column {
        std::string name;
        std::size_t function;  // index in all_
    };

    // One time history is "sensor". Several are "function" with the place in the file.
    void name_columns() {
        for (const std::size_t i : histories_) {
            columns_.push_back(
                {histories_.size() == 1 ? "sensor" : fmt::format("function{}", i + 1), i});
        }
    }
    std::size_t of(const std::string& name) const {
        return std::ranges::find(columns_, name, &Column::name)->function;
    }
    bool has_times() const {
        return std::ranges::any_of(histories_, [&](std::size_t i) { return !all_[i].even; });
    }
    std::size_t first_uneven() const {
        return *std::ranges::find_if(histories_, [&](std::size_t i) { return !all_[i].even; });
    }
    // Stored times of the columns in use.
    std::vector<double> times() const {
        const auto rate = sampling_.rate_Hz();
        if (!rate) {
            return all_[times_.value_or(first_uneven())].abscissae;
        }
        std::vector<double> even(count_);
        for (std::size_t i = 0; i < count_; ++i) {
            even[i] = static_cast<double>(i) / *rate;
        }
        return even;
    }
    // Seconds in a unit of the abscissa.
    double unit_of_abscissa(const std::string& name, const UffFunction& function) const {
        const auto factor = unit_factor(Quantity::time, function.abscissa.unit);
        if (!factor) {
            throw SignalError(fmt::format("{}: column {}: {} is not a known unit of its times",
                                          path_, name, function.abscissa.unit));
        }
        return *factor;
    }

    std::string path_;
    std::vector<UffFunction> all_;
    std::vector<std::size_t> histories_;  // indices of the real time histories
    std::vector<Column> columns_;
    CommonSampling sampling_;
    std::vector<std::string> notes_;
    std::size_t count_ = 0;             // samples of the evenly spaced column read last
    std::optional<std::size_t> times_;  // function whose stored times the columns in use have
};

}  // namespace

std::unique_ptr<SignalFile> open_signal_uff(const std::string& path) {
    return std::make_unique<SignalUff>(path);
}

}  // namespace gearpod::mc
