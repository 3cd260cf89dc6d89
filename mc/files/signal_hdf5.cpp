// Reads HDF5 files of signals, as `simulate` and other programs write them. Links are followed
// within the file only; nothing in other files is ever opened.
#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>

#include "machine/no_value.hpp"
#include "mc/files/hdf5_data.hpp"
#include "mc/files/input/input_file.hpp"
#include "mc/files/input/number_text.hpp"
#include "mc/files/input/terminal_text.hpp"
#include "mc/files/signal_file.hpp"
#include "mc/files/signal_units.hpp"

namespace gearpod::mc {
namespace {

constexpr std::string_view kUnitNames =
    "unit units unitstring physicalunit physicalunits engineeringunit engineeringunits engunits";
constexpr std::string_view kScaleNames = "scale scalefactor scalingfactor conversion";
constexpr std::string_view kUnusedNames =
    "gain multiplier sensitivity calibration calibrationfactor calfactor slope intercept bias";
constexpr std::size_t kDeepestGroup = 32, kMostLinks = 1000000;

// Attribute that any program may have written: either texts, of fixed or variable length, or
// numbers; one for a scalar. Both are empty for other types and for more than a thousand values.
struct Hdf5Attribute {
    std::string name;
    std::vector<std::string> texts;
    std::vector<double> numbers;

    // The only number, also if it is written as text.
    std::optional<double> number() const {
        return numbers.size() == 1 ? std::optional(numbers.front())
               : texts.size() == 1 ? parsed_number<double>(texts.front())
                                   : std::nullopt;
    }
};

std::vector<std::string> attribute_texts(hid_t attribute, hid_t stored, std::size_t count) {
    constexpr std::size_t kLongestText = 1 << 16;
    std::vector<std::string> texts;
    const Hdf5Handle memory(H5Tcopy(stored), H5Tclose, "text");
    const std::size_t size = H5Tget_size(stored);
    if (H5Tis_variable_str(stored) > 0) {
        const Hdf5Handle space(H5Aget_space(attribute), H5Sclose, "text");
        std::vector<char*> pointers(count, nullptr);
        check(H5Aread(attribute, memory.get(), pointers.data()), "text");
        for (const char* pointer : pointers) {
            texts.emplace_back(pointer == nullptr ? "" : pointer);
        }
        H5Dvlen_reclaim(memory.get(), space.get(), H5P_DEFAULT, pointers.data());
    } else if (size > 0 && size <= kLongestText) {
        std::string bytes(size * count, '\0');
        check(H5Aread(attribute, memory.get(), bytes.data()), "text");
        for (std::size_t i = 0; i < count; ++i) {
            // Padding is zeros, or blanks in files of Fortran programs.
            std::string text = bytes.substr(i * size, size);
            text.resize(std::min(text.find('\0'), text.size()));
            text.resize(text.find_last_not_of(' ') + 1);
            texts.push_back(text);
        }
    }
    return texts;
}

herr_t read_attribute(hid_t object, const char* name, const H5A_info_t*, void* to) {
    constexpr hssize_t kMostValues = 1000;
    try {
        Hdf5Attribute read{name, {}, {}};
        const Hdf5Handle attribute(H5Aopen(object, name, H5P_DEFAULT), H5Aclose, name);
        const Hdf5Handle space(H5Aget_space(attribute.get()), H5Sclose, name);
        const Hdf5Handle type(H5Aget_type(attribute.get()), H5Tclose, name);
        const hssize_t count = H5Sget_simple_extent_npoints(space.get());
        const H5T_class_t kind = H5Tget_class(type.get());
        const auto values = static_cast<std::size_t>(count);
        if (count > 0 && count <= kMostValues && kind == H5T_STRING) {
            read.texts = attribute_texts(attribute.get(), type.get(), values);
        } else if (count > 0 && count <= kMostValues &&
                   (kind == H5T_FLOAT || kind == H5T_INTEGER)) {
            read.numbers.resize(values);
            check(H5Aread(attribute.get(), H5T_NATIVE_DOUBLE, read.numbers.data()), name);
        }
        static_cast<std::vector<Hdf5Attribute>*>(to)->push_back(std::move(read));
        return 0;
    } catch (const std::exception&) {
        return -1;
    }
}

std::vector<Hdf5Attribute> attributes_of(hid_t object) {
    std::vector<Hdf5Attribute> all;
    hsize_t at = 0;
    check(H5Aiterate2(object, H5_INDEX_NAME, H5_ITER_INC, &at, read_attribute, &all), "attributes");
    return all;
}

// Reason why a file cannot be opened as HDF5: it was not closed, is truncated, or is another kind
// of file, which is named. Source of the offsets: HDF5 File Format Specification 3.0, section II.A
// (superblock).
std::string open_problem(const std::string& path) {
    using std::string_view_literals::operator""sv;
    std::ifstream file(path, std::ios::binary);
    std::error_code error;
    const std::uint64_t size = std::filesystem::file_size(path, error);
    if (error || !file) {
        return "cannot be read";
    }
    std::string head;
    for (std::uint64_t at = 0; at < size && !head.starts_with("\x89HDF\r\n\x1a\n");
         at = at == 0 ? 512 : 2 * at) {
        head.assign(64, '\0');
        file.clear();
        file.seekg(static_cast<std::streamoff>(at));
        file.read(head.data(), static_cast<std::streamsize>(head.size()));
        if (at == 0 && head.starts_with("<")) {
            return "is an HTML or XML text";
        }
        if (at == 0 && head.starts_with("\0\0\0\0\0\0\0\0"sv)) {
            return "is without HDF5 signature: it begins with zeros, as if the program that wrote "
                   "it did not close it";
        }
    }
    if (!head.starts_with("\x89HDF\r\n\x1a\n")) {
        return size == 0 ? "is empty"
                         : "is not an HDF5 file, or is damaged: it has no HDF5 signature";
    }
    const char version = head[8];
    const bool first_form = version == 0 || version == 1;
    if (!first_form && (head[11] & 5) != 0) {
        return "is open in another program, or the program that wrote it did not close it; if no "
               "program has it open, repair a copy with: h5clear -s " +
               path;
    }
    if (head[first_form ? 13 : 9] != 8) {
        return "is a damaged HDF5 file";
    }
    std::uint64_t end = 0;  // little-endian
    std::memcpy(&end, head.data() + (version == 0 ? 40 : version == 1 ? 44 : 28), sizeof end);
    return end > size ? fmt::format(
                            "is truncated ({} of {} bytes), or the program that wrote it did not "
                            "close it; copy or write it again",
                            size, end)
                      : "is damaged, or the program that wrote it did not close it; copy or write "
                        "it again";
}

// Paths of all datasets and links, found by walking through the groups, each once.
struct Hdf5Walk {
    std::vector<std::string> datasets, elsewhere;
    std::vector<std::pair<std::string, std::string>> links;  // path, and the path it stands for
    std::set<haddr_t> groups = {};
    std::set<std::string> group_paths = {};
    std::string group = "";  // path of the present one with a slash at its end, "" for the root
    std::size_t depth = 0, count = 0;
};

// Path of a soft link's target without a slash at its start.
std::string target_of(hid_t group, const char* name, std::size_t size, const std::string& around) {
    std::string target(size + 1, '\0');
    check(H5Lget_val(group, name, target.data(), target.size(), H5P_DEFAULT), name);
    target.resize(target.find('\0'));
    return target.starts_with('/') ? target.substr(1) : around + target;
}

herr_t visit_link(hid_t group, const char* name, const H5L_info_t* link, void* data) {
    auto& walk = *static_cast<Hdf5Walk*>(data);
    const std::string path = walk.group + name;
    if (++walk.count > kMostLinks) {
        return -1;
    }
    try {
        if (link->type == H5L_TYPE_SOFT) {
            walk.links.emplace_back(path, target_of(group, name, link->u.val_size, walk.group));
            return 0;
        }
        if (link->type != H5L_TYPE_HARD) {
            walk.elsewhere.push_back(path);
            return 0;
        }
        H5O_info_t info{};
        check(H5Oget_info_by_name2(group, name, &info, H5O_INFO_BASIC, H5P_DEFAULT), name);
        if (info.type == H5O_TYPE_DATASET) {
            walk.datasets.push_back(path);
        } else if (info.type == H5O_TYPE_GROUP && walk.depth < kDeepestGroup &&
                   walk.groups.insert(info.addr).second) {
            const std::string around = std::exchange(walk.group, path + "/");
            walk.group_paths.insert(path);
            ++walk.depth;
            const Hdf5Handle inner = open_group(group, name);
            hsize_t at = 0;
            check(H5Literate(inner.get(), H5_INDEX_NAME, H5_ITER_INC, &at, visit_link, data), name);
            --walk.depth;
            walk.group = around;
        }
        return 0;
    } catch (const std::exception&) {
        return -1;
    }
}

// Type of the values of a dataset, or of a field of its rows.
Hdf5Handle value_type(const Hdf5Handle& dataset, const std::string& field) {
    Hdf5Handle type(H5Dget_type(dataset.get()), H5Tclose, field);
    if (field.empty()) {
        return type;
    }
    const int index = H5Tget_member_index(type.get(), field.c_str());
    return {H5Tget_member_type(type.get(), static_cast<unsigned>(index)), H5Tclose, field};
}

// Names of the fields if a dataset is a table of rows.
std::vector<std::string> fields_of(hid_t file, const std::string& path) {
    std::vector<std::string> fields;
    try {
        const Hdf5Handle dataset = open_dataset(file, path);
        const Hdf5Handle type = value_type(dataset, "");
        const bool rows =
            H5Tget_class(type.get()) == H5T_COMPOUND && shape_of(dataset, path).size() == 1;
        for (int i = 0; rows && i < H5Tget_nmembers(type.get()); ++i) {
            char* const name = H5Tget_member_name(type.get(), static_cast<unsigned>(i));
            fields.emplace_back(name);
            H5free_memory(name);
        }
    } catch (const Hdf5Error&) {
        fields.clear();  // reported if the dataset is chosen
    }
    return fields;
}

// Names are paths without a slash at their start; those in the group /signals, if it exists, also
// omit "signals/". Signals are vectors of numbers, also N x 1, columns of matrices and fields of
// tables of rows ("table/field"); with `row`, the rows of two-dimensional datasets.
class SignalHdf5 : public NamedColumns {
  public:
    SignalHdf5(const std::string& path, std::optional<std::size_t> row)
        : NamedColumns(path, "path"), row_(row), file_(open_file(path, path)) {
        Hdf5Walk walk;
        const Hdf5Handle root = open_group(file_.get(), "/");
        H5O_info_t info{};
        check(H5Oget_info2(root.get(), &info, H5O_INFO_BASIC), path);
        walk.groups.insert(info.addr);
        hsize_t at = 0;
        check(H5Literate(root.get(), H5_INDEX_NAME, H5_ITER_INC, &at, visit_link, &walk), path);
        std::vector<std::pair<std::string, std::string>> all;
        for (const std::string& dataset : walk.datasets) {
            all.emplace_back(dataset, dataset);
        }
        // Soft links stand for datasets, directly or by a group in their path.
        for (const auto& [link, target] : walk.links) {
            for (const std::string& dataset : walk.datasets) {
                if (dataset == target || dataset.starts_with(target + "/")) {
                    all.emplace_back(link + dataset.substr(target.size()), dataset);
                }
            }
        }
        groups_ = std::move(walk.group_paths);
        const auto in_signals = [](const auto& named) {
            return named.first.starts_with("signals/");
        };
        base_ = std::ranges::any_of(all, in_signals) ? "signals/" : "";
        const auto shown_name = [&](const std::string& full) {
            return full.starts_with(base_) ? full.substr(base_.size()) : full;
        };
        for (const auto& [name, dataset] : all) {
            datasets_.emplace(shown_name(name), Dataset{dataset});
            for (const std::string& field :
                 row ? std::vector<std::string>() : fields_of(file_.get(), dataset)) {
                datasets_.emplace(shown_name(name + "/" + field), Dataset{dataset, {}, {}, field});
            }
        }
        for (const std::string& link : walk.elsewhere) {
            datasets_.emplace(shown_name(link), Dataset{"", Content::elsewhere, {}});
        }
        for (const auto& [name, dataset] : datasets_) {
            names_.push_back(name);
        }
    }

    std::vector<std::string> names() const override {
        std::vector<std::string> all;
        std::ranges::copy_if(names_, std::back_inserter(all),
                             [&](const std::string& name) { return is_signal(inspected(name)); });
        return all;
    }

    std::string contents() override {
        constexpr std::size_t kDescribed = 20;
        std::vector<std::string> texts;
        for (const std::string& name : names_) {
            texts.push_back(texts.size() < kDescribed ? text_of(name) : "");
        }
        return listed_text(texts);
    }

    std::vector<double> read(const std::string& name) override {
        try {
            std::vector<double> values = stored_values(name);
            apply_scale(name, values);
            return values;
        } catch (const Hdf5Error&) {
            throw SignalError(fmt::format("{}: {} {}", path_, printable(name),
                                          missing_filter(datasets_.at(part_named(name).matrix))));
        }
    }

    std::string unit(const std::string& name) override {
        try {
            std::string unit = stated_unit(name, attributes(name));
            const std::string group = group_of(name, '/');
            if (unit.empty()) {
                const std::string around = stated_unit(name, group_attributes(group));
                if (!around.empty() && signals_in(group) == 1) {
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
        try {
            std::vector<NumberStatement> all;
            if (!name.empty()) {
                add_rates(attributes(name), all);
            }
            for (std::string group = group_of(name, '/'); all.empty();
                 group = group_of(group, '/')) {
                add_rates(group_attributes(group), all);
                add_scalar_rates(group, all);
                if (group.empty()) {
                    break;
                }
            }
            if (all.empty()) {
                add_rates(attributes_of(open_group(file_.get(), "/").get()), all);
            }
            return agreed_rate_Hz(all, path_);
        } catch (const Hdf5Error&) {
            throw SignalError(path_ + ": its attributes cannot be read");
        }
    }

  private:
    enum class Content { numbers, text, compound, other, elsewhere };
    struct Dataset {
        std::string path;
        std::optional<Content> content = {};  // empty until it is inspected
        Shape shape = {};
        std::string field = {};  // of its rows

        // Number of columns of a matrix; 0 if it is none.
        std::size_t columns() const {
            const auto form = signal_form(shape);
            return form && form->columns ? shape[*form->columns] : 0;
        }
    };

    [[noreturn]] void refuse(const std::string& what) const {
        throw SignalError(fmt::format("{}: {}", path_, printable(what)));
    }

    // Name of a dataset, and the number of a column of it, as in "data:2"; 0: the dataset itself.
    MatrixColumn part_named(const std::string& name) const {
        const auto part = matrix_column(name);
        return part && !datasets_.contains(name) ? *part : MatrixColumn{name, 0};
    }

    const Dataset& inspected(const std::string& name) const {
        Dataset& dataset = datasets_.at(name);
        if (dataset.content) {
            return dataset;
        }
        const Hdf5Handle opened = open_dataset(file_.get(), dataset.path);
        const Hdf5Handle created(H5Dget_create_plist(opened.get()), H5Pclose, name);
        const Hdf5Handle type = value_type(opened, dataset.field);
        H5T_class_t kind = H5Tget_class(type.get());
        const bool elsewhere =
            H5Pget_external_count(created.get()) > 0 || H5Pget_layout(created.get()) == H5D_VIRTUAL;
        dataset.content = elsewhere                                  ? Content::elsewhere
                          : kind == H5T_FLOAT || kind == H5T_INTEGER ? Content::numbers
                          : kind == H5T_STRING                       ? Content::text
                          : kind == H5T_COMPOUND                     ? Content::compound
                                                                     : Content::other;
        if (!elsewhere) {
            dataset.shape = shape_of(opened, name);
        }
        // A field of several values is a matrix whose rows are those of the table.
        if (kind == H5T_ARRAY && !dataset.field.empty() && H5Tget_array_ndims(type.get()) == 1) {
            const Hdf5Handle value(H5Tget_super(type.get()), H5Tclose, name);
            kind = H5Tget_class(value.get());
            dataset.shape.push_back(0);
            H5Tget_array_dims2(type.get(), &dataset.shape.back());
            if ((kind == H5T_FLOAT || kind == H5T_INTEGER) && dataset.shape[0] > dataset.shape[1]) {
                dataset.content = Content::numbers;
            }
        }
        return dataset;
    }

    bool is_signal(const Dataset& dataset) const {
        return dataset.content == Content::numbers &&
               (row_ ? dataset.shape.size() == 2
                     : signal_form(dataset.shape).has_value() && dataset.columns() == 0);
    }

    // Number of vectors of more than one value directly in a group.
    std::ptrdiff_t signals_in(const std::string& group) const {
        return std::ranges::count_if(names_, [&](const std::string& name) {
            return group_of(name, '/') == group && is_signal(inspected(name)) &&
                   std::ranges::any_of(inspected(name).shape,
                                       [](hsize_t size) { return size > 1; });
        });
    }

    std::string text_of(const std::string& name) const {
        const Dataset& dataset = inspected(name);
        const std::string shown = printable(name), shape = shape_text(dataset.shape);
        if (dataset.content != Content::numbers) {
            return shown + (dataset.content == Content::text        ? " (text)"
                            : dataset.content == Content::compound  ? " (compound)"
                            : dataset.content == Content::elsewhere ? " (in another file)"
                                                                    : " (not numbers)");
        }
        if (!row_ && dataset.columns() > 0) {
            return fmt::format("{} ({}; {}:1 to {}:{})", shown, shape, shown, shown,
                               dataset.columns());
        }
        return dataset.shape.empty() ? shown + " (one number)"
                                     : fmt::format("{} ({})", shown, shape);
    }

    std::vector<std::string> matching(const ColumnChoice& choice) const override {
        ColumnChoice plain = choice;
        plain.name.erase(0, plain.name.find_first_not_of('/'));
        std::vector<std::string> found = matching_columns(names_, plain, '/');
        if (found.empty() && !base_.empty() && plain.name.starts_with(base_)) {
            plain.name.erase(0, base_.size());
            found = matching_columns(names_, plain, '/');
        }
        return found;
    }

    std::string problem_of(const std::string& name) const override {
        const MatrixColumn part = part_named(name);
        const Dataset& dataset = inspected(part.matrix);
        const std::string whole = printable(part.matrix), shape = shape_text(dataset.shape);
        const std::size_t columns = dataset.columns(), most = std::max<std::size_t>(columns, 1);
        const bool is_column = part.matrix != name;
        if (dataset.content == Content::elsewhere) {
            return whole +
                   " is stored in another file (by a link, or external or virtual storage), which "
                   "is not supported; copy it into this file, for example with h5copy or h5py's "
                   "group.copy";
        }
        if (dataset.content != Content::numbers) {
            return text_of(part.matrix) + " is not a column of numbers";
        }
        if (row_ && !is_column) {
            return dataset.shape.size() == 2
                       ? ""
                       : fmt::format("{} has no rows: its shape is {}", whole, shape);
        }
        if (!signal_form(dataset.shape)) {
            return fmt::format(
                "{} has the shape {}; a column must be a vector, or a column of a "
                "matrix whose longer dimension is time",
                whole, shape);
        }
        if (is_column && (part.column < 1 || part.column > most)) {
            return fmt::format("{}: {} has {} columns, counted from 1", printable(name), whole,
                               most);
        }
        return !is_column && columns > 0
                   ? fmt::format("{} is a matrix of {}; choose one of its columns, {}:1 to {}:{}",
                                 whole, shape, whole, whole, columns)
                   : "";
    }

    // Reason why the values of a dataset cannot be read: a filter that HDF5 lacks, or damage.
    std::string missing_filter(const Dataset& dataset) const {
        const Hdf5Handle opened = open_dataset(file_.get(), dataset.path);
        const Hdf5Handle list(H5Dget_create_plist(opened.get()), H5Pclose, dataset.path);
        const int filters = H5Pget_nfilters(list.get());
        for (int i = 0; i < filters; ++i) {
            unsigned flags = 0, config = 0;
            std::size_t values = 0;
            char name[80] = "";
            const H5Z_filter_t filter =
                H5Pget_filter2(list.get(), static_cast<unsigned>(i), &flags, &values, nullptr,
                               sizeof name, name, &config);
            if (filter > 0 && H5Zfilter_avail(filter) <= 0) {
                return fmt::format(
                    "is compressed by the filter {} ({}), which is not supported: "
                    "write a copy without it, h5repack -f NONE IN OUT where that "
                    "filter is installed, or ptrepack --complevel 0 IN OUT",
                    filter, printable(name));
            }
        }
        return "cannot be read";
    }

    // Values of a signal, of a matrix column, or of a row.
    std::vector<double> stored_values(const std::string& name) const {
        const MatrixColumn part = part_named(name);
        const Dataset& dataset = inspected(part.matrix);
        Shape start(dataset.shape.size(), 0), count = dataset.shape;
        const auto form = signal_form(dataset.shape);
        if (row_) {
            if (*row_ >= dataset.shape.at(0)) {
                refuse(fmt::format("{} has {} rows, but row {} is requested (counted from 0)", name,
                                   dataset.shape[0], *row_));
            }
            start[0] = *row_;
            count[0] = 1;
        } else if (part.matrix != name && dataset.columns() > 0) {
            start[*form->columns] = part.column - 1;
            count[*form->columns] = 1;
        }
        // Compressed values may be much larger than the file.
        constexpr std::size_t kMostCompressed = 1000;
        const hsize_t values =
            count_of(count, kMostCompressed * std::filesystem::file_size(path_), name);
        const Hdf5Handle opened = open_dataset(file_.get(), dataset.path);
        if (!dataset.field.empty()) {
            return field_values(opened, dataset, part.matrix != name ? part.column - 1 : 0);
        }
        const Hdf5Handle space(H5Dget_space(opened.get()), H5Sclose, name);
        if (!count.empty()) {
            check(H5Sselect_hyperslab(space.get(), H5S_SELECT_SET, start.data(), nullptr,
                                      count.data(), nullptr),
                  name);
        }
        const Hdf5Handle memory(H5Screate_simple(1, &values, nullptr), H5Sclose, name);
        std::vector<double> read(values);
        check(H5Dread(opened.get(), H5T_NATIVE_DOUBLE, memory.get(), space.get(), H5P_DEFAULT,
                      read.data()),
              name);
        return read;
    }

    // Values of a field of all rows, or of one column of it.
    static std::vector<double> field_values(const Hdf5Handle& opened, const Dataset& dataset,
                                            std::size_t column) {
        const std::string& field = dataset.field;
        const bool several = dataset.shape.size() > 1;
        const hsize_t width = several ? dataset.shape[1] : 1;
        const Hdf5Handle array(H5Tarray_create2(H5T_NATIVE_DOUBLE, 1, &width), H5Tclose, field);
        const Hdf5Handle row(H5Tcreate(H5T_COMPOUND, width * sizeof(double)), H5Tclose, field);
        check(H5Tinsert(row.get(), field.c_str(), 0, several ? array.get() : H5T_NATIVE_DOUBLE),
              field);
        std::vector<double> all(dataset.shape.at(0) * width), values;
        check(H5Dread(opened.get(), row.get(), H5S_ALL, H5S_ALL, H5P_DEFAULT, all.data()), field);
        for (std::size_t i = column; i < all.size(); i += width) {
            values.push_back(all[i]);
        }
        return values;
    }

    std::vector<Hdf5Attribute> attributes(const std::string& name) const {
        const std::string& path = datasets_.at(part_named(name).matrix).path;
        return attributes_of(open_dataset(file_.get(), path).get());
    }

    std::vector<Hdf5Attribute> group_attributes(const std::string& group) const {
        // The group of a name at the top is /signals, if it exists.
        const std::string inner = group_of(base_ + group + (group.empty() ? "" : "/"), '/');
        const std::string& path = groups_.contains(inner) ? inner : group;
        return path.empty() || groups_.contains(path)
                   ? attributes_of(open_group(file_.get(), "/" + path).get())
                   : std::vector<Hdf5Attribute>();
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
        const auto part = matrix_column(name);
        const bool each =
            part && datasets_.contains(part->matrix) && values == inspected(part->matrix).columns();
        return values == 1 ? 0 : each ? part->column - 1 : values;
    }

    // Applies value = raw * scale + offset (CF conventions, section 8.1; NWB conversion, offset).
    void apply_scale(const std::string& name, std::vector<double>& values) {
        std::optional<double> scale, offset;
        std::string scale_name, offset_name;
        const auto take = [&](std::optional<double>& to, std::string& of,
                              const Hdf5Attribute& attribute) {
            std::optional<double> number = attribute.number();
            const std::size_t part = part_of(name, attribute.numbers.size());
            if (!number && part < attribute.numbers.size()) {
                number = attribute.numbers[part];
            }
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
        for (const Hdf5Attribute& attribute : attributes(name)) {
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
        if (offset.value_or(0.0) != 0.0 && scale.value_or(1.0) != 1.0 &&
            plain_name(offset_name) == "offset" && plain_name(scale_name) != "conversion") {
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
            if (stated_rate_Hz({attribute.name, 1.0})) {
                const auto number = attribute.number();
                if (!number) {
                    refuse(fmt::format("the attribute {} must be one number", attribute.name));
                }
                rates.push_back({attribute.name, *number});
            }
        }
    }

    // Adds datasets of one number directly in a group.
    void add_scalar_rates(const std::string& group, std::vector<NumberStatement>& rates) const {
        for (const std::string& name : names_) {
            const std::string leaf = leaf_of(name, '/');
            if (group_of(name, '/') != group || !stated_rate_Hz({leaf, 1.0})) {
                continue;
            }
            const Dataset& dataset = inspected(name);
            if (dataset.content == Content::numbers &&
                std::ranges::all_of(dataset.shape, [](hsize_t n) { return n == 1; })) {
                rates.push_back({leaf, read_numbers(file_.get(), dataset.path, 1).values.front()});
            }
        }
    }

    std::optional<std::size_t> row_;
    Hdf5Handle file_;
    std::string base_;  // "signals/" or ""
    std::set<std::string> groups_;
    std::vector<std::string> names_;
    mutable std::map<std::string, Dataset> datasets_;  // by name
};

}  // namespace

std::unique_ptr<SignalFile> open_signal_hdf5(const std::string& path,
                                             std::optional<std::size_t> row) {
    try {
        return std::make_unique<SignalHdf5>(path, row);
    } catch (const Hdf5Error&) {
        throw SignalError(path + ": " + open_problem(path));
    }
}

}  // namespace gearpod::mc
