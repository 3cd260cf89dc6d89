// Inline table in a list of a study file, such as { frequency_Hz = 50, amplitude_m_s2 = 0.1 }.
#pragma once

#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "mc/files/input/document.hpp"
#include "mc/study/distributions/range.hpp"
#include "mc/study/keys/key.hpp"

namespace gearpod::mc {

// Shafts that may have a bearing in the housing.
inline constexpr ChoiceName kShafts[] = {{"sun", static_cast<int>(Member::sun)},
                                         {"carrier", static_cast<int>(Member::carrier)},
                                         {"ring", static_cast<int>(Member::ring)},
                                         {"pinion", static_cast<int>(Member::pinion)},
                                         {"gear", static_cast<int>(Member::gear)}};

inline constexpr Range kAbove0{.low = 0.0, .low_open = true};

// Roles of a source of vibration elsewhere.
inline constexpr ChoiceName kSourceRoles[] = {
    {"background", static_cast<int>(SourceRole::background)},
    {"other_fault", static_cast<int>(SourceRole::other_fault)}};

// Reads the values of one table. Whatever is wrong is rejected, and the value is then 0 or empty.
class ListElement {
  public:
    // `which` names the table in messages ("tone 2"). Unknown names are rejected.
    ListElement(const Value& table, std::string which, std::span<const TableField> fields,
                std::string example, const RejectElement& reject);

    bool has(std::string_view name) const { return table_.find(name) != nullptr; }
    // Number in a range; required without a value that stands for it.
    double number(std::string_view name, const Range& range,
                  std::optional<double> otherwise = {}) const;
    int integer(std::string_view name, const Range& range) const;
    // List of numbers in a range, or a column of a file; empty if it is missing.
    std::vector<double> numbers(std::string_view name, const Range& range) const;
    // Value of one of the choices; empty if it is missing, which is rejected where it is required.
    std::optional<int> choice(std::string_view name, std::span<const ChoiceName> choices,
                              bool required) const;
    // Text; empty if it is missing, or if it is no text, which is rejected.
    std::optional<std::string> text(std::string_view name) const;
    // Required text of lower-case letters, digits and dashes; "" if it is rejected.
    std::string word(std::string_view name) const;
    // Member named by `name`, which is required: one of kShafts.
    std::optional<Member> shaft(std::string_view name = "shaft") const;
    // Rejects the table unless it has exactly one of two names. True if it has the first.
    bool first_of(std::string_view first, std::string_view second) const;
    // Rejects a statement of the table.
    void reject(const std::string& what, const std::string& remedy) const;

  private:
    // Rejects a value that is no finite number in the range.
    void check_number(std::string_view name, const Range& range, const Value& value) const;
    // The entry of that name. Without it, the name is rejected where it is required.
    const Value* find(std::string_view name, bool required) const;

    const Value& table_;
    std::string which_, example_;
    const RejectElement& reject_;
    bool spelled_ = true;  // false if any name is unknown; names are then not reported as missing
};

// Frequency responses of universal files (dataset 58) as columns of numbers.

// Denominator of a frequency response whose numerator is an acceleration.
enum class ResponseTo { acceleration, force };

// Column "frequency" (Hz), "gain" or "phase" (degrees) of such a frequency response in a file; a
// gain per force in (m/s^2)/N. Of several, number n in the order of the file has the columns
// "frequency n" and so on. Throws SignalError (mc/files/signal_file.hpp) for another column and for
// a response that is no such ratio.
std::vector<double> uff_response_column(const std::string& path, const std::string& column,
                                        ResponseTo to = ResponseTo::acceleration);

// Lists of numbers read from a column of a text table, { file = "F.csv", column = "NAME" }, or of a
// frequency response in a universal file.

struct FileColumn {
    std::string file, column;
};

// File and column named by a table; empty for any other value.
std::optional<FileColumn> file_column(const Value& value);

// The column's numbers as a list at `position`. Of more than `most` rows every n-th one is used.
// Universal files are read only for keys of a frequency response ("response_"). Throws SignalError
// (mc/files/signal_file.hpp) with the problem.
Value list_of(const FileColumn& source, std::string_view key, const Position& position,
              std::size_t most = std::numeric_limits<std::size_t>::max());

}  // namespace gearpod::mc
