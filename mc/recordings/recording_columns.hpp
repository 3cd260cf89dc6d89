// Sampling times of a recording, with checks for missing and clipped samples.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "mc/files/signal_file.hpp"
#include "mc/files/signal_units.hpp"

namespace gearpod::mc {

// Evenly spaced times, or a description of the problem.
struct SampleTimes {
    std::vector<double> seconds;
    std::string problem;
};

// Evenly spaced times, s, from a column that may have been rounded: to decimals, to significant
// digits, or to single or double precision. `factor` converts the column to seconds. Missing
// samples, and times that stand still or run back by more than the rounding, are reported with
// their position; so are times rounded so coarsely that a missing sample would not show.
SampleTimes sample_times(std::vector<double> column, double factor = 1.0);

// The values 0, 1, 2, ... divided by `rate`.
std::vector<double> evenly_spaced(std::size_t samples, double rate);

// Continues a signal of whole planet turns periodically by some samples; does nothing for other
// lengths and for empty signals. Otherwise a finer grid would lose its points after the last
// sample, and with them the last mesh period.
void extend_periodically(const std::vector<std::vector<double>*>& signals,
                         std::vector<double>& phase, double samples_per_turn);

// Returns "" unless values are not finite or too large to compute with.
std::string bad_values(std::span<const double> values);

// Returns "" unless the signal is clipped: several runs of equal samples at its largest or smallest
// value that begin and end with jumps above the resolution.
std::string clipping(std::span<const double> samples);

// Columns of a recording: found by name, converted to the program's units and checked.

// Use of the speed that the mesh lines show (signals/spectra/wide_speed.hpp).
enum class SpeedCheck {
    refuse,  // reject a recording whose lines fit another speed clearly better
    follow,  // use that speed
    ignore,
};

// Columns of a signal file to read; "" for optional ones.
struct SignalColumns {
    std::string sensor;                   // default "sensor", if it exists
    std::string te;                       // default "te", if it exists
    double sampling_Hz = 0.0;             // 0: from the file
    double samples_per_mesh = 0.0;        // for even sampling in mesh phase; 0: sampled in time
    std::optional<std::size_t> row = {};  // for a file with one record per row
    SensorUnit sensor_unit = {};          // without any and without a unit in the file: m/s^2
    std::string tachometer = {};  // pulses of the member whose speed the study gives; "": none
    double pulses_per_turn = 1.0;
    std::string encoder = {};  // angle of that member; "": none
    SpeedCheck speed = SpeedCheck::refuse;
    std::string time = {};  // default "time", or another usual name, if it exists
};

// The values, each multiplied by the factor.
std::vector<double> scaled(std::vector<double> values, double factor);

// Reader of one file. Problems are collected and thrown together by stop_at_problems().
class RecordingColumns {
  public:
    // Both must outlive the object.
    RecordingColumns(const SignalSource& source, const SignalColumns& columns)
        : source_(source), columns_(columns) {}

  protected:
    void reject(const std::string& what);
    void reject_column(const std::string& name, const std::string& why);
    void stop_at_problems() const;
    void reject_missing(const std::string& name);
    // Full name of a column; "" if it does not exist. All columns belong to the first one.
    std::string found(const std::string& name, bool requested);
    // Names a column of speeds, pulses or angles that is not used, with its use; "": none.
    std::string unused_text();
    // Factor that converts a column to the program's units.
    double factor(const std::string& name, Quantity quantity);
    // Name of the column of times: that of --time, or one of its usual names; "": none.
    std::string time_column();
    // Reads a column that the user requested.
    std::vector<double> present(const std::string& name, Quantity quantity);
    // Reads a column and checks that it is finite and as long as the others.
    std::vector<double> column(const std::string& name, Quantity quantity);
    std::vector<double> chosen(const std::string& name, const std::string& usual,
                               Quantity quantity);
    // Time of every sample, s.
    std::vector<double> times(std::size_t samples);
    // Sampling rate as stated, and that or the rate of the times; 0 if it is not known.
    double stated_rate_Hz();
    double rate_Hz();
    // Adds a note if the file states another sampling rate than the one used.
    void compare_with_stated_rate(double used_Hz);
    // Time of a sample as text, " (1.5 s)"; "" if it is not known. Samples are numbered from 1.
    std::string moment(std::size_t sample);

    const SignalSource& source_;
    const SignalColumns& columns_;
    std::unique_ptr<SignalFile> file_;
    std::string problems_, first_;  // `first_`: name of the first column that was read
    std::vector<std::string> notes_;
    std::size_t samples_ = 0;
};

}  // namespace gearpod::mc
