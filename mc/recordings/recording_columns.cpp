#include "mc/recordings/recording_columns.hpp"

#include <fmt/format.h>

#include <cmath>

#include "mc/input/printable.hpp"
#include "mc/recordings/sample_times.hpp"

namespace gearpod::mc {
namespace {

constexpr const char* kTimeColumn = "time";

}  // namespace

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
    const std::string written_as = columns_.sampling_Hz > 0.0 ? "" : found(kTimeColumn, false);
    if (!written_as.empty()) {
        std::vector<double> written = column(written_as, Quantity::time);
        if (!problems_.empty()) {
            return {};
        }
        SampleTimes time = sample_times(std::move(written), factor(written_as, Quantity::time));
        reject_column(kTimeColumn, time.problem);
        if (time.problem.empty()) {
            compare_with_stated_rate(static_cast<double>(time.seconds.size() - 1) /
                                     (time.seconds.back() - time.seconds.front()));
        }
        return std::move(time.seconds);
    }
    const double rate = columns_.sampling_Hz > 0.0 ? columns_.sampling_Hz
                                                   : file_->sampling_Hz_of(first_).value_or(0.0);
    if (!(rate > 0.0 && std::isfinite(rate))) {
        reject(
            fmt::format("no sampling rate: the file has neither a column {} or {} nor "
                        "sampling_Hz; its columns are {}; give --sampling-Hz",
                        kTimeColumn, "mesh_phase", file_->contents()));
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

std::string RecordingColumns::moment(std::size_t sample) {
    const std::string time = columns_.sampling_Hz > 0.0 ? "" : found(kTimeColumn, false);
    const double rate = columns_.sampling_Hz > 0.0 ? columns_.sampling_Hz
                                                   : file_->sampling_Hz_of(first_).value_or(0.0);
    const double seconds = sample == 0 || time.empty()
                               ? static_cast<double>(sample - 1) / rate
                               : file_->read(time).at(sample - 1) * factor(time, Quantity::time);
    return sample > 0 && std::isfinite(seconds) ? fmt::format(" ({:.6g} s)", seconds) : "";
}

}  // namespace gearpod::mc
