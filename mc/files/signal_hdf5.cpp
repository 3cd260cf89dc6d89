// Reads HDF5 files of signals, as `simulate` and other programs write them.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "machine/no_value.hpp"
#include "mc/files/column_search.hpp"
#include "mc/files/hdf5_data.hpp"
#include "mc/files/hdf5_index.hpp"
#include "mc/files/input/file_text.hpp"
#include "mc/files/input/terminal_text.hpp"
#include "mc/files/signal_units.hpp"

namespace gearpod::mc {
namespace {

constexpr std::string_view kUnitNames =
    "unit units unitstring physicalunit physicalunits engineeringunit engineeringunits engunits";
constexpr std::string_view kScaleNames = "scale scalefactor scalingfactor conversion";
constexpr std::string_view kUnusedNames =
    "gain multiplier sensitivity calibration calibrationfactor calfactor slope intercept bias";

class SignalHdf5 : public NamedColumns {
  public:
    SignalHdf5(const std::string& path, std::optional<std::size_t> row)
        : NamedColumns(path, "path"),
          row_(row),
          most_(std::filesystem::file_size(path)),
          index_(path, row.has_value()) {}

    std::vector<std::string> names() const override {
        const SilentHdf5 silent;
        return index_.signals();
    }

    std::string contents() override {
        const SilentHdf5 silent;
        return index_.contents();
    }

    std::string find(const ColumnChoice& choice) override {
        const SilentHdf5 silent;
        return NamedColumns::find(choice);
    }

    std::vector<double> read(const std::string& name) override {
        const SilentHdf5 silent;
        try {
            // Compressed values may be much larger than the file.
            constexpr std::size_t kMostCompressed = 1000;
            std::vector<double> values = index_.read(name, row_, kMostCompressed * most_);
            apply_scale(name, values);
            return values;
        } catch (const Hdf5Error&) {
            throw SignalError(fmt::format("{}: {} cannot be read", path_, printable(name)));
        }
    }

    std::string unit(const std::string& name) override {
        const SilentHdf5 silent;
        try {
            std::string unit = stated_unit(name, index_.attributes(name));
            const std::string group = group_of(name, '/');
            if (unit.empty()) {
                const std::string around = stated_unit(name, index_.group_attributes(group));
                if (!around.empty() && index_.signals_in(group) == 1) {
                    unit = around;
                } else if (!around.empty()) {
                    add_note(fmt::format("unit {} of the group of {} is not used", around, name));
                }
            }
            return unit;
        } catch (const Hdf5Error&) {
            throw SignalError(
                fmt::format("{}: the attributes of {} cannot be read", path_, printable(name)));
        }
    }

    std::optional<double> sampling_Hz_of(const std::string& name) override {
        const SilentHdf5 silent;
        try {
            std::vector<NumberStatement> all;
            if (!name.empty()) {
                add_rates(index_.attributes(name), all);
            }
            for (std::string group = group_of(name, '/'); all.empty();
                 group = group_of(group, '/')) {
                add_rates(index_.group_attributes(group), all);
                for (const auto& [dataset, value] : index_.scalars_in(group)) {
                    add_rates({{leaf_of(dataset, '/'), {}, {value}}}, all);
                }
                if (group.empty()) {
                    break;
                }
            }
            if (all.empty()) {
                add_rates(index_.root_attributes(), all);
            }
            return agreed_rate_Hz(all, path_);
        } catch (const Hdf5Error&) {
            throw SignalError(path_ + ": its attributes cannot be read");
        }
    }

  private:
    [[noreturn]] void refuse(const std::string& what) const {
        throw SignalError(fmt::format("{}: {}", path_, printable(what)));
    }
    std::vector<std::string> matching(const ColumnChoice& choice) const override {
        return index_.matching(choice);
    }
    std::string problem_of(const std::string& name) const override {
        return printable(index_.problem_of(name));
    }

    // Statements of the unit; if they differ, a text that is no unit and shows them.
    std::string stated_unit(const std::string& name, const std::vector<Hdf5Attribute>& all) const {
        std::string unit, first;
        for (const Hdf5Attribute& attribute : all) {
            if (!is_among(plain_name(attribute.name), kUnitNames)) {
                continue;
            }
            const std::size_t part = part_of(name, attribute.texts.size());
            if (part >= attribute.texts.size()) {
                refuse(
                    fmt::format("the attribute {} of {} must be one text", attribute.name, name));
            }
            const std::string& text = attribute.texts[part];
            if (text.empty() || lower_case(text) == "none") {
                continue;
            }
            if (!unit.empty() && plain_unit(text) != plain_unit(unit)) {
                return fmt::format("{} (attribute {}) but {} (attribute {})", unit, first, text,
                                   attribute.name);
            }
            unit = unit.empty() ? text : unit;
            first = first.empty() ? attribute.name : first;
        }
        return unit;
    }

    // Index of the value for a column among those of an attribute: 0 for a scalar; that of the
    // column if there is one for each column of a matrix; else the number of values.
    std::size_t part_of(const std::string& name, std::size_t values) const {
        if (values == 1) {
            return 0;
        }
        const auto part = matrix_column(name);
        return part && values == index_.columns_of(part->matrix) ? part->column - 1 : values;
    }

    std::optional<double> number_of_attribute(const std::string& name,
                                              const Hdf5Attribute& attribute) const {
        if (const auto number = attribute.number()) {
            return number;
        }
        const std::size_t part = part_of(name, attribute.numbers.size());
        return part < attribute.numbers.size() ? std::optional(attribute.numbers[part])
                                               : std::nullopt;
    }

    // Applies value = raw * scale + offset (CF conventions, section 8.1; NWB conversion, offset).
    void apply_scale(const std::string& name, std::vector<double>& values) {
        std::optional<double> scale, offset;
        std::string scale_name, offset_name;
        const auto take = [&](std::optional<double>& to, std::string& of,
                              const Hdf5Attribute& attribute) {
            const auto number = number_of_attribute(name, attribute);
            if (!number) {
                refuse(
                    fmt::format("the attribute {} of {} must be one number", attribute.name, name));
            }
            if (to && *to != *number) {
                refuse(fmt::format("{} has the attributes {} = {:g} and {} = {:g}; they differ",
                                   name, of, *to, attribute.name, *number));
            }
            to = number;
            of = attribute.name;
        };
        for (const Hdf5Attribute& attribute : index_.attributes(name)) {
            const std::string plain = plain_name(attribute.name);
            if (is_among(plain, kScaleNames)) {
                take(scale, scale_name, attribute);
            } else if (plain == "addoffset" || plain == "offset") {
                take(offset, offset_name, attribute);
            } else if (plain == "fillvalue" || plain == "missingvalue") {
                for (double& value : values) {
                    value = std::ranges::count(attribute.numbers, value) > 0 ? kNan : value;
                }
            } else if (const auto number = attribute.number();
                       number && *number != 1.0 && is_among(plain, kUnusedNames)) {
                add_note(fmt::format("attribute {} = {:g} of {} is not used", attribute.name,
                                     *number, name));
            }
        }
        const std::string by = plain_name(scale_name);
        if (offset.value_or(0.0) != 0.0 && scale.value_or(1.0) != 1.0 &&
            plain_name(offset_name) == "offset" && by != "conversion") {
            refuse(
                fmt::format("{} has {} = {:g} and offset = {:g}, in an order that is not "
                            "defined; name them scale_factor and add_offset",
                            name, scale_name, *scale, *offset));
        }
        for (double& value : values) {
            value = scale ? value * *scale : value;
            value = offset ? value + *offset : value;
        }
    }

    void add_rates(const std::vector<Hdf5Attribute>& attributes,
                   std::vector<NumberStatement>& rates) const {
        for (const Hdf5Attribute& attribute : attributes) {
            if (!stated_rate_Hz({attribute.name, 1.0})) {
                continue;
            }
            const auto number = attribute.number();
            if (!number) {
                refuse(fmt::format("the attribute {} must be one number", attribute.name));
            }
            rates.push_back({attribute.name, *number});
        }
    }

    std::optional<std::size_t> row_;
    std::size_t most_;
    Hdf5Index index_;
};

}  // namespace

std::unique_ptr<SignalFile> open_signal_hdf5(const std::string& path,
                                             std::optional<std::size_t> row) {
    const SilentHdf5 silent;
    try {
        return std::make_unique<SignalHdf5>(path, row);
    } catch (const Hdf5Error&) {
        const std::string problem = hdf5_open_problem(path);
        throw SignalError(
            fmt::format("{}: {}", path, problem.empty() ? "is a damaged HDF5 file" : problem));
    }
}

}  // namespace gearpod::mc
