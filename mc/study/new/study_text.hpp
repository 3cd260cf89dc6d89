// Lines and sections of a study's text that planetary gearboxes and gear pairs share.
#pragma once

#include <functional>
#include <initializer_list>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "mc/study/new/datasheet.hpp"
#include "mc/study/study.hpp"

namespace gearpod::mc {

// Formats a number to four significant digits, with an exponent from a million on.
std::string rounded_text(double value);

// Formats a key with its value and the source of the value. Numbers are rounded to four digits.
std::string line(const std::string& key, const std::string& value, const std::string& comment);
std::string line(const std::string& key, double value, const std::string& comment = "");
// The same for a given number, to nine digits.
std::string given_line(const std::string& key, double value, const std::string& comment = "");

// Tables of members within [gearbox], in the order in which they are named.
class MemberTables {
  public:
    explicit MemberTables(std::initializer_list<const char*> members);

    // Lines of a member's table.
    std::string& operator[](const std::string& member);
    std::string text() const;

  private:
    std::vector<std::pair<std::string, std::string>> tables_;
};

// First comment of a study: kind of gearbox, command, notes of the datasheet, sources of the rules.
// Then its title, which says where the stage lies in its machine or that it is alone.
std::string study_header(const StageDatasheet& data, const std::string& gearbox,
                         const std::string& command, const std::string& name,
                         const std::string& fault);

// Module, helix, pressure angle, addendum, centre distance, material, face width and tooth profile.
std::string teeth_lines(const StageDatasheet& data, double face_width_mm);

// Teeth of a gear, and its profile shift and tip diameter where they are given.
std::string gear_lines(int teeth, const std::optional<double>& shift,
                       const std::optional<double>& tip_mm);

// Sensor rates, Hz.
struct SensorRates {
    double low_pass = 0, sampling = 0;
};

// Density of the background without a measured level, m/s^2/sqrt(Hz); 0.1 m/s^2 up to 10 kHz.
inline constexpr double kChosenDensity = 1e-3;

// Background noise of the machine at the sensor, and the levels of it that a study compares. At
// sampling rates far above the low-pass the rms of white noise takes the place of its density.
struct Background {
    const char* key;
    double value;
    std::vector<double> levels;
};

// Sensor of a stage with this mesh frequency. Its rates are those for twenty mesh harmonics,
// limited to the range of a general-purpose accelerometer, unless the low-pass is given. At higher
// mesh frequencies a mesh period still has enough samples for the encoders and the windows.
struct NewSensor {
    double mesh_frequency_Hz;
    SensorRates rates;
    Background background;
};
NewSensor new_sensor(const StageDatasheet& data, double mesh_frequency_Hz);

// Torque and speed of the driving member.
std::string load_lines(const StageDatasheet& data, const InputLoad& load,
                       const std::string& speed_key);

std::string effects_section(const std::string& path);

// Section [sensor]. `place`: the keys of the sensor's position and path.
std::string sensor_section(const StageDatasheet& data, const NewSensor& sensor,
                           const std::string& place);

// Line of [random], and distributions for it.
std::string varied(const std::string& key, const std::string& distribution);
std::string lognormal(double median, double cv);
// Torque of 5 % scatter within 15 %.
std::string varied_torque(double torque_N_m);
// Levels of a crack's depth up to 80 % of the deepest one.
std::string varied_depth(double deepest_m);

inline constexpr double kDefaultQuality = 6;  // ISO 1328 grade

// Sections [features], [detection] and [ensemble]. The noise is chosen unless a level was measured,
// and the tooth quality unless the datasheet gives it.
std::string output_sections(const StageDatasheet& data, const Background& noise);

// Makes a study and checks it. `teeth`: minimal study whose reading checks the teeth. `text_of`:
// the study by its gears and the load of the `driver`.
NewStudy checked_study(
    const StageDatasheet& data, const DatasheetSource& source, const std::string& driver,
    const std::string& teeth,
    const std::function<std::string(const Study& teeth, const InputLoad& load)>& text_of);

}  // namespace gearpod::mc
