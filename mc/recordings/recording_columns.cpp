#include "mc/recordings/recording_columns.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>

#include "machine/contracts.hpp"
#include "machine/upper_median.hpp"
#include "mc/files/input/input_file.hpp"
#include "mc/files/input/terminal_text.hpp"

namespace gearpod::mc {
namespace {

constexpr const char* kTimeColumn = "time";
constexpr double kEven = 1e-3;  // relative to a step
// Largest unit of rounded times, relative to a step. Steps are whole numbers of units: one or two
// where no sample is missing, three or more over a missing sample.
constexpr double kCoarsest = 1.0 / 1.5;

// Rounding of written times: its unit grows with the value, except that of decimals.
class WrittenPrecision {
  public:
    // Finds the coarsest precision with which all values may have been written: decimals, three to
    // nine significant digits, or single precision. Double precision is the finest.
    explicit WrittenPrecision(const std::vector<double>& values) {
        for (const double value : values) {
            largest_ = std::max(largest_, std::abs(value));
        }
        find_decimals(values);
        find_digits(values);
        find_single(values);
    }

    // Distance of neighbouring values of the format at this value.
    double unit(double value) const {
        const double digits = digits_ > 0 ? digit_unit(value, digits_) : 0.0;
        return std::max({decimals_, digits, single_ * ulp(static_cast<float>(value))}) + ulp(value);
    }
    double largest_unit() const { return unit(largest_); }

  private:
    template <class Number>
    static Number ulp(Number value) {
        const Number size = std::abs(value);
        return std::nextafter(size, std::numeric_limits<Number>::infinity()) - size;
    }
    // Exponent of ten of the last of `digits` significant digits.
    static int last_digit(double value, int digits) {
        return static_cast<int>(std::floor(std::log10(std::abs(value)) + 1e-12)) + 1 - digits;
    }
    static double digit_unit(double value, int digits) {
        return value == 0.0 ? 0.0 : std::pow(10.0, last_digit(value, digits));
    }
    // True if a value is a multiple of a power of ten, to within double precision.
    static bool is_multiple(double value, int exponent) {
        const long double power = std::pow(10.0L, std::abs(exponent));
        const long double multiple = exponent < 0 ? value * power : value / power;
        const double one = std::pow(10.0, exponent), off = 8.0 * ulp(value) / one;
        // Computed values are off by some units of double precision, written ones by one.
        const double blur = off < 0.05 ? off : 1.01 * ulp(value) / one;
        return blur < 0.3 && std::abs(multiple - std::round(multiple)) <= blur;
    }

    void find_decimals(const std::vector<double>& values) {
        for (int digits = 0; digits <= 9 && decimals_ == 0.0; ++digits) {
            if (std::ranges::all_of(values, [&](double v) { return is_multiple(v, -digits); })) {
                decimals_ = std::pow(10.0, -digits);
            }
        }
    }
    void find_digits(const std::vector<double>& values) {
        for (int digits = 3; digits <= 9 && digits_ == 0; ++digits) {
            if (std::ranges::all_of(values, [&](double v) {
                    return v == 0.0 || is_multiple(v, last_digit(v, digits));
                })) {
                digits_ = digits;
            }
        }
    }
    // Numbers of single precision, written exactly, with enough digits, or with the fewest digits
    // that distinguish them.
    void find_single(const std::vector<double>& values) {
        const auto shortest = [](double value) {
            std::array<char, 32> text{};
            const auto end =
                std::to_chars(text.data(), text.data() + text.size(), static_cast<float>(value));
            double read = 0.0;
            std::from_chars(text.data(), end.ptr, read);
            return read == value;
        };
        const auto near = [&](double value) {
            const bool nine = is_multiple(value, last_digit(value, 9));
            const double written =
                std::max(decimals_, nine ? digit_unit(value, 9) : 0.0) + ulp(value);
            return written < 0.25 * ulp(static_cast<float>(value)) &&
                   std::abs(value - static_cast<float>(value)) <= 0.51 * written;
        };
        if (std::ranges::all_of(values, [&](double value) {
                return value == static_cast<float>(value) || near(value);
            })) {
            single_ = 1.0;
        } else if (std::ranges::all_of(values, shortest)) {
            single_ = 2.0;
        }
    }

    double largest_ = 0.0;
    double decimals_ = 0.0;  // unit of the last decimal; 0: none
    int digits_ = 0;         // significant digits; 0: none
    double single_ = 0.0;    // largest rounding error of single precision, in half units; 0: none
};

// Line through the times by least squares.
struct TimeLine {
    double start = 0.0, step = 0.0;
    double at(std::size_t i) const { return start + static_cast<double>(i) * step; }
};

TimeLine fitted_line(const std::vector<double>& time) {
    const auto last = static_cast<double>(time.size() - 1);
    // From the first time: sums of large times would be less accurate.
    double mean = 0.0, slope = 0.0, squares = 0.0;
    for (const double value : time) {
        mean += (value - time.front()) / (last + 1.0);
    }
    for (std::size_t i = 0; i < time.size(); ++i) {
        const double from_middle = static_cast<double>(i) - 0.5 * last;
        slope += from_middle * (time[i] - time.front() - mean);
        squares += from_middle * from_middle;
    }
    TimeLine line;
    line.step = slope / squares;
    line.start = time.front() + (mean - 0.5 * last * line.step);
    return line;
}

// Largest deviation from even spacing.
double unevenness(const std::vector<double>& time, const TimeLine& line) {
    double most = 0.0;
    for (std::size_t i = 0; i < time.size(); ++i) {
        most = std::max(most, std::abs(time[i] - line.at(i)));
    }
    return most;
}

// First step, from 1, that rounding does not explain; 0 if there is none.
std::size_t unexplained_step(const std::vector<double>& time, double step,
                             const WrittenPrecision& precision) {
    for (std::size_t i = 1; i < time.size(); ++i) {
        const double rounding = 0.5005 * (precision.unit(time[i - 1]) + precision.unit(time[i]));
        // Times that were rounded twice are off by more than half a unit each.
        const double twice = std::min(2.0 * rounding, 0.25 * step);
        if (std::abs(time[i] - time[i - 1] - step) > std::max({rounding, twice, kEven * step})) {
            return i;
        }
    }
    return 0;
}

std::vector<double> steps_of(const std::vector<double>& time, double factor) {
    std::vector<double> steps;
    for (std::size_t i = 1; i < time.size(); ++i) {
        steps.push_back((time[i] - time[i - 1]) * factor);
    }
    return steps;
}

// Mean of the steps about as long as their median.
double usual_step(const std::vector<double>& steps, double unit) {
    const double median = machine::upper_median(steps);
    double sum = 0.0, count = 0.0;
    for (const double step : steps) {
        if (std::abs(step - median) <= std::max(0.5 * median, 1.01 * unit)) {
            sum += step;
            count += 1.0;
        }
    }
    return sum / count;
}

// Reports steps that are too long, too short or negative; `unit` is that of the rounding, s.
std::string spacing_problem(const std::vector<double>& steps, double unit) {
    const auto back =
        std::find_if(steps.begin(), steps.end(), [&](double step) { return step < -1.01 * unit; });
    if (back != steps.end()) {
        return fmt::format(
            "decreases by {:.6g} s from sample {} to the next; the samples must be evenly spaced",
            -*back, back - steps.begin() + 1);
    }
    const double usual = usual_step(steps, unit);
    const bool coarse = unit > kCoarsest * usual;
    const double allowed = std::max(0.5 * usual, coarse ? 0.0 : 1.001 * unit);
    for (std::size_t i = 0; i < steps.size() && usual > unit * 0.5; ++i) {
        if (std::abs(steps[i] - usual) <= allowed) {
            continue;
        }
        const double samples = std::round(steps[i] / usual) - 1.0;
        return fmt::format(
            "there are {:.6g} s between sample {} and the next, and {:.6g} s between most "
            "samples{}{}",
            steps[i], i + 1, usual,
            samples >= 1.0 ? fmt::format(": {:.0f} sample(s) are missing; use only the part before "
                                         "or after",
                                         samples)
                           : "; the samples must be evenly spaced",
            coarse ? fmt::format("; or the times, which are rounded to {:.3g} s, are too coarse: "
                                 "then state the rate with --sampling-Hz",
                                 unit)
                   : "");
    }
    if (coarse) {
        return fmt::format(
            "the times are rounded to {:.3g} s, too coarse for samples every {:.6g} s: a missing "
            "sample would not show; write more digits, or state the rate with --sampling-Hz",
            unit, usual);
    }
    const auto worst = std::max_element(steps.begin(), steps.end(), [&](double a, double b) {
        return std::abs(a - usual) < std::abs(b - usual);
    });
    return fmt::format(
        "{:.6g} s from sample {} to the next, but {:.6g} s on average; the samples "
        "must be evenly spaced",
        *worst, worst - steps.begin() + 1, usual);
}

}  // namespace

SampleTimes sample_times(std::vector<double> column, double factor) {
    EXPECTS(column.size() >= 2);
    const auto [low, high] = std::ranges::minmax(column);
    if (low == high) {
        return {{}, fmt::format("is {:.17g} at all samples", low)};
    }
    const double average =
        (column.back() - column.front()) / static_cast<double>(column.size() - 1);
    bool even = average > 0.0;
    for (std::size_t i = 1; i < column.size() && even; ++i) {
        even = std::abs(column[i] - column[i - 1] - average) <= kEven * average;
    }
    if (!even) {
        // A fitted line is more accurate than rounded times.
        const WrittenPrecision precision(column);
        const TimeLine line = fitted_line(column);
        const double unit = precision.largest_unit();
        const double allowed = std::max(kEven * line.step, 1.01 * unit);
        if (!(line.step > 0.0) || unit > kCoarsest * line.step ||
            unevenness(column, line) > allowed ||
            unexplained_step(column, line.step, precision) > 0) {
            return {{}, spacing_problem(steps_of(column, factor), unit * factor)};
        }
        for (std::size_t i = 0; i < column.size(); ++i) {
            column[i] = line.at(i);
        }
    }
    for (double& value : column) {
        value *= factor;
    }
    return {std::move(column), ""};
}

std::vector<double> evenly_spaced(std::size_t samples, double rate) {
    std::vector<double> values(samples);
    for (std::size_t i = 0; i < samples; ++i) {
        values[i] = static_cast<double>(i) / rate;
    }
    return values;
}

void extend_periodically(const std::vector<std::vector<double>*>& signals,
                         std::vector<double>& phase, double samples_per_turn) {
    constexpr std::size_t kMore = 8;
    const double turns = static_cast<double>(phase.size()) / samples_per_turn;
    if (std::abs(turns - std::round(turns)) > 1e-9 || phase.size() < kMore) {
        return;
    }
    const double step = phase[1] - phase[0];
    for (std::size_t i = 0; i < kMore; ++i) {
        phase.push_back(step * static_cast<double>(phase.size()));
        for (std::vector<double>* signal : signals) {
            if (!signal->empty()) {
                signal->push_back((*signal)[i]);
            }
        }
    }
}

std::string bad_values(std::span<const double> values) {
    constexpr double kLargest = 1e18;
    const auto is_bad = [](double value) { return !std::isfinite(value); };
    const auto bad = std::find_if(values.begin(), values.end(), is_bad);
    if (bad != values.end()) {
        return fmt::format(
            "{} of {} samples are not finite, the first is sample {}; cut them off or fill the "
            "gaps",
            std::count_if(values.begin(), values.end(), is_bad), values.size(),
            bad - values.begin() + 1);
    }
    const auto huge = std::find_if(values.begin(), values.end(),
                                   [](double value) { return std::abs(value) > kLargest; });
    return huge == values.end()
               ? ""
               : fmt::format("sample {} is {:g}; numbers above {:g} are not supported",
                             huge - values.begin() + 1, *huge, kLargest);
}

std::string clipping(std::span<const double> samples) {
    constexpr std::size_t kRun = 3;
    constexpr long kFewestRuns = 2;
    constexpr double kJump = 4.0;  // times the smallest difference between samples
    const auto [low, high] = std::minmax_element(samples.begin(), samples.end());
    double resolution = std::numeric_limits<double>::infinity();
    for (std::size_t i = 1; i < samples.size(); ++i) {
        const double difference = std::abs(samples[i] - samples[i - 1]);
        resolution = difference > 0.0 ? std::min(resolution, difference) : resolution;
    }
    long runs = 0, clipped = 0;
    double level = 0.0;
    for (std::size_t i = 0; i < samples.size();) {
        std::size_t end = i + 1;  // starts at i + 1 because a NaN does not equal itself
        while (end < samples.size() && samples[end] == samples[i]) {
            ++end;
        }
        const bool extreme = samples[i] == *high || samples[i] == *low;
        const bool steep = i > 0 && end < samples.size() &&
                           std::abs(samples[i] - samples[i - 1]) > kJump * resolution &&
                           std::abs(samples[i] - samples[end]) > kJump * resolution;
        if (extreme && steep && end - i >= kRun && *high > *low) {
            ++runs;
            clipped += static_cast<long>(end - i);
            level = samples[i];
        }
        i = end;
    }
    return runs >= kFewestRuns ? fmt::format(
                                     "clipped: {} samples in {} runs have the extreme value "
                                     "{:.6g}; record with a larger range",
                                     clipped, runs, level)
                               : "";
}

std::vector<double> scaled(std::vector<double> values, double factor) {
    if (factor != 1.0) {
        for (double& value : values) {
            value *= factor;
        }
    }
    return values;
}

void RecordingColumns::reject(const std::string& what) {
    problems_ +=
        fmt::format("{}{}: {}", problems_.empty() ? "" : "\n", source_.name, printable(what));
}

void RecordingColumns::reject_column(const std::string& name, const std::string& why) {
    if (!why.empty()) {
        reject(fmt::format("column {}: {}", name, why));
    }
}

void RecordingColumns::stop_at_problems() const {
    if (!problems_.empty()) {
        throw SignalError(problems_);
    }
}

void RecordingColumns::reject_missing(const std::string& name) {
    reject(fmt::format("no column {}; its columns are {}", name, file_->contents()));
}

std::string RecordingColumns::found(const std::string& name, bool requested) {
    return file_->find({name, first_, requested});
}

std::string RecordingColumns::unused_text() {
    constexpr std::pair<const char*, const char*> kUses[] = {
        {"tach", "--tachometer {}"}, {"puls", "--tachometer {}"},  {"encoder", "--encoder {}"},
        {"angle", "--encoder {}"},   {"rpm", "name it speed_rpm"}, {"speed", "name it speed_rpm"}};
    for (const std::string& name : file_->names()) {
        for (const auto& [part, use] : kUses) {
            if (name != first_ && lower_case(name).find(part) != std::string::npos) {
                return fmt::format("; column {} is not used: {}", printable(name),
                                   fmt::format(fmt::runtime(use), printable(name)));
            }
        }
    }
    return "";
}

double RecordingColumns::factor(const std::string& name, Quantity quantity) {
    const ColumnFactor factor = column_factor(file_->unit(name), quantity, columns_.sensor_unit);
    reject_column(name, factor.problem);
    if (!factor.note.empty()) {
        notes_.push_back(printable(fmt::format("column {}: {}", name, factor.note)));
    }
    return factor.factor;
}

std::vector<double> RecordingColumns::present(const std::string& name, Quantity quantity) {
    const std::string full = found(name, true);
    if (full.empty()) {
        reject_missing(name);
    }
    return full.empty() ? std::vector<double>() : column(full, quantity);
}

std::vector<double> RecordingColumns::column(const std::string& name, Quantity quantity) {
    // Times are converted after their rounding has been judged.
    const double unit = quantity == Quantity::time ? 1.0 : factor(name, quantity);
    std::vector<double> values = scaled(file_->read(name), unit);
    reject_column(name, bad_values(values));
    if (values.size() < 2) {
        reject(fmt::format("column {} has {} sample(s)", name, values.size()));
    } else if (samples_ != 0 && values.size() != samples_) {
        reject(fmt::format("column {} has {} samples, but {} has {}", name, values.size(), first_,
                           samples_));
    } else if (samples_ == 0) {
        samples_ = values.size();
        first_ = name;
    }
    return values;
}

std::vector<double> RecordingColumns::chosen(const std::string& name, const std::string& usual,
                                             Quantity quantity) {
    const std::string taken = found(name.empty() ? usual : name, !name.empty());
    if (!taken.empty()) {
        std::vector<double> values = column(taken, quantity);
        reject_column(taken, clipping(values));
        return values;
    }
    if (!name.empty()) {
        reject_missing(name);
    }
    return {};
}

std::vector<double> RecordingColumns::times(std::size_t samples) {
    const std::string written_as = time_column();
    if (!written_as.empty()) {
        std::vector<double> written = column(written_as, Quantity::time);
        if (!problems_.empty()) {
            return {};
        }
        const auto counts = [&](double& value) {
            return value == written.front() + static_cast<double>(&value - written.data());
        };
        if (file_->unit(written_as).empty() && std::ranges::all_of(written, counts)) {
            reject_column(written_as,
                          fmt::format("counts the samples ({:g}, {:g}, ...): it is not in s; give "
                                      "--sampling-Hz",
                                      written[0], written[1]));
            return {};
        }
        SampleTimes time = sample_times(std::move(written), factor(written_as, Quantity::time));
        reject_column(written_as, time.problem);
        if (time.problem.empty()) {
            compare_with_stated_rate(static_cast<double>(time.seconds.size() - 1) /
                                     (time.seconds.back() - time.seconds.front()));
        }
        return std::move(time.seconds);
    }
    const double rate = stated_rate_Hz();
    if (!(rate > 0.0 && std::isfinite(rate))) {
        reject(
            fmt::format("no sampling rate: the file has neither a column {} or {} nor "
                        "sampling_Hz; its columns are {}; give --sampling-Hz or --time",
                        kTimeColumn, "mesh_phase", file_->contents()));
        return {};
    }
    if (constexpr double kLeast_Hz = 1e-3; rate < kLeast_Hz) {
        reject(
            fmt::format("a sampling rate of {:g} Hz resolves no mesh; correct --sampling-Hz or "
                        "the rate in the file",
                        rate));
        return {};
    }
    if (columns_.sampling_Hz > 0.0) {
        compare_with_stated_rate(rate);
    }
    return evenly_spaced(samples, rate);
}

void RecordingColumns::compare_with_stated_rate(double used_Hz) {
    constexpr double kAgreement = 1e-2;
    try {
        const double stated_Hz = file_->sampling_Hz_of(first_).value_or(used_Hz);
        if (!(std::abs(stated_Hz - used_Hz) <= kAgreement * used_Hz)) {
            notes_.push_back(fmt::format(
                "the file states a sampling rate of {:.6g} Hz; taken as {:.6g} Hz ({})", stated_Hz,
                used_Hz, columns_.sampling_Hz > 0.0 ? "--sampling-Hz" : "column time"));
        }
    } catch (const SignalError& error) {
        notes_.push_back(printable(error.what()));
    }
}

std::string RecordingColumns::time_column() {
    if (columns_.sampling_Hz > 0.0) {
        return "";
    }
    if (!columns_.time.empty()) {
        const std::string name = found(columns_.time, true);
        if (name.empty()) {
            reject_missing(columns_.time);
        }
        return name;
    }
    for (const char* usual : {kTimeColumn, "Time", "TIME", "t", "T", "X_Value", "X:Time",
                              "Timestamp", "timestamp", "TIMESTAMP"}) {
        if (const std::string name = found(usual, false); !name.empty()) {
            return name;
        }
    }
    return "";
}

double RecordingColumns::stated_rate_Hz() {
    return columns_.sampling_Hz > 0.0 ? columns_.sampling_Hz
                                      : file_->sampling_Hz_of(first_).value_or(0.0);
}

double RecordingColumns::rate_Hz() {
    const std::string time = time_column();
    if (time.empty()) {
        return stated_rate_Hz();
    }
    const std::vector<double> values = file_->read(time);
    const double rate = static_cast<double>(values.size() - 1) /
                        ((values.back() - values.front()) * factor(time, Quantity::time));
    return std::isfinite(rate) && rate > 0.0 ? rate : 0.0;
}

std::string RecordingColumns::moment(std::size_t sample) {
    if (sample == 0) {
        return "";
    }
    const std::string time = time_column();
    const double seconds = time.empty()
                               ? static_cast<double>(sample - 1) / stated_rate_Hz()
                               : file_->read(time).at(sample - 1) * factor(time, Quantity::time);
    return std::isfinite(seconds) ? fmt::format(" ({:.6g} s)", seconds) : "";
}

}  // namespace gearpod::mc
