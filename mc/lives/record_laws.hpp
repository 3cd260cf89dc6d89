// What a record has of its own: torque, speed, gain and noise, as factors on its gearbox's. Said by
// the scatter keys of [life], which are lognormal laws about the gearbox's value in short, or in
// [random] with per = "record". Either way a record has one standard normal number for each, which
// its law turns into a factor.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "mc/study/study.hpp"

namespace gearpod::mc {

class RecordLaw {
  public:
    // `scatter`: rms of the factor's logarithm, where [random] gives no law for the quantity.
    RecordLaw(const Study& study, RecordQuantity quantity, double scatter);

    bool varies() const { return input_.has_value() || scatter_ > 0.0; }
    // By [random].
    bool given() const { return input_.has_value(); }
    // Rises with the standard normal number.
    double factor(double unit) const;
    // Root of the mean square that noise of such factors averages to; a little more of short laws.
    double rms() const;
    // Ascending factors at which a gearbox is marched for records in between, those of so many
    // evenly spaced numbers from -1.5 to 1.5, two or more; one where nothing varies.
    std::vector<double> marched(int count) const;
    // One between each of these and the next, of the number halfway.
    std::vector<double> between(int count) const;
    // "scatters by 2 % (rms) about the gearbox's", "lognormal, ..."
    std::string text() const;

  private:
    double scatter_;
    std::optional<RandomInput> input_;
    double nominal_ = 1.0;  // in the unit of the distribution
};

struct RecordLaws {
    explicit RecordLaws(const Study& study);

    RecordLaw torque, speed, gain, noise;
    bool noise_of_sensor_alone;  // else of the encoders as well
};

// How much of what is marched at these ascending factors makes up another, along the line between
// its neighbours or, beyond the ends, between the outer two.
std::vector<double> shares_of(const std::vector<double>& marched, double factor);

// The study as its gearboxes see it: inputs of records stay at their nominal values.
Study study_of_gearboxes(const Study& study);

}  // namespace gearpod::mc
