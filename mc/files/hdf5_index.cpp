#include "mc/files/hdf5_index.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <set>
#include <string_view>

#include "mc/files/input/number_text.hpp"
#include "mc/files/input/terminal_text.hpp"

namespace gearpod::mc {
namespace {

constexpr hssize_t kMostAttributeValues = 1000;

// Text without padding: zeros, or blanks in files of Fortran programs.
std::string unpadded(const char* text, std::size_t size) {
    std::string_view view(text, size);
    view = view.substr(0, view.find('\0'));
    const std::size_t last = view.find_last_not_of(' ');
    return std::string(view.substr(0, last == std::string_view::npos ? 0 : last + 1));
}

std::vector<std::string> attribute_texts(hid_t attribute, hid_t stored, std::size_t count) {
    std::vector<std::string> texts;
    const Hdf5Handle memory(H5Tcopy(stored), H5Tclose, "text");
    if (H5Tis_variable_str(stored) > 0) {
        const Hdf5Handle space(H5Aget_space(attribute), H5Sclose, "text");
        std::vector<char*> pointers(count, nullptr);
        check(H5Aread(attribute, memory.get(), pointers.data()), "text");
        for (const char* pointer : pointers) {
            texts.emplace_back(pointer == nullptr ? "" : pointer);
        }
        H5Dvlen_reclaim(memory.get(), space.get(), H5P_DEFAULT, pointers.data());
        return texts;
    }
    constexpr std::size_t kLongestText = 1 << 16;
    const std::size_t size = H5Tget_size(stored);
    if (size == 0 || size > kLongestText) {
        return {};
    }
    std::vector<char> bytes(size * count, '\0');
    check(H5Aread(attribute, memory.get(), bytes.data()), "text");
    for (std::size_t i = 0; i < count; ++i) {
        texts.push_back(unpadded(bytes.data() + i * size, size));
    }
    return texts;
}

herr_t read_attribute(hid_t object, const char* name, const H5A_info_t*, void* to) {
    try {
        Hdf5Attribute read{name, {}, {}};
        const Hdf5Handle attribute(H5Aopen(object, name, H5P_DEFAULT), H5Aclose, name);
        const Hdf5Handle space(H5Aget_space(attribute.get()), H5Sclose, name);
        const Hdf5Handle type(H5Aget_type(attribute.get()), H5Tclose, name);
        const hssize_t count = H5Sget_simple_extent_npoints(space.get());
        const H5T_class_t kind = H5Tget_class(type.get());
        if (count > 0 && count <= kMostAttributeValues) {
            const auto values = static_cast<std::size_t>(count);
            if (kind == H5T_STRING) {
                read.texts = attribute_texts(attribute.get(), type.get(), values);
            } else if (kind == H5T_FLOAT || kind == H5T_INTEGER) {
                read.numbers.resize(values);
                check(H5Aread(attribute.get(), H5T_NATIVE_DOUBLE, read.numbers.data()), name);
            }
        }
        static_cast<std::vector<Hdf5Attribute>*>(to)->push_back(std::move(read));
        return 0;
    } catch (const std::exception&) {
        return -1;
    }
}

// Beginnings of other kinds of files.
struct FileBeginning {
    std::string_view begin;
    const char* name;
};
using namespace std::string_view_literals;
constexpr FileBeginning kFileBeginnings[] = {
    {"RIFF"sv, "a WAV or other RIFF file"},
    {"<"sv, "an HTML or XML text"},
    {"\x00\x00\x00\x00\x00\x00\x00\x00"sv,
     "without HDF5 signature: it begins with zeros, as if the program that wrote it did not close "
     "it"},
};

}  // namespace

std::optional<double> Hdf5Attribute::number() const {
    if (numbers.size() == 1) {
        return numbers.front();
    }
    return texts.size() == 1 ? parsed_number<double>(texts.front()) : std::nullopt;
}

std::vector<Hdf5Attribute> attributes_of(hid_t object) {
    std::vector<Hdf5Attribute> all;
    hsize_t at = 0;
    check(H5Aiterate2(object, H5_INDEX_NAME, H5_ITER_INC, &at, read_attribute, &all), "attributes");
    return all;
}

// Source of the offsets: HDF5 File Format Specification 3.0, section II.A (superblock).
std::string hdf5_open_problem(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    std::error_code error;
    const std::uint64_t size = std::filesystem::file_size(path, error);
    if (error || !file) {
        return "cannot be read";
    }
    if (size == 0) {
        return "is empty";
    }
    constexpr std::string_view kSignature = "\x89HDF\r\n\x1a\n"sv;
    std::array<char, 64> bytes{};
    for (std::uint64_t at = 0; at < size; at = at == 0 ? 512 : 2 * at) {
        bytes.fill('\0');
        file.clear();
        file.seekg(static_cast<std::streamoff>(at));
        file.read(bytes.data(), bytes.size());
        const std::string_view head(bytes.data(), bytes.size());
        if (!head.starts_with(kSignature)) {
            if (at == 0) {
                const auto kind = std::ranges::find_if(
                    kFileBeginnings,
                    [&](const FileBeginning& one) { return head.starts_with(one.begin); });
                if (kind != std::end(kFileBeginnings)) {
                    return fmt::format("is {}", kind->name);
                }
            }
            continue;
        }
        const auto* const raw = reinterpret_cast<const unsigned char*>(bytes.data());
        const unsigned version = raw[8];
        const bool first_form = version < 2;
        if (!first_form && (raw[11] & 5U) != 0) {
            return fmt::format(
                "is open in another program, or the program that wrote it did not close it; if no "
                "program has it open, repair a copy with: h5clear -s {}",
                path);
        }
        if (raw[first_form ? 13 : 9] != 8) {
            return "";
        }
        const std::size_t at_end = first_form ? (version == 1 ? 44 : 40) : 28;
        std::uint64_t end = 0;
        for (std::size_t i = 8; i-- > 0;) {
            end = end << 8 | raw[at_end + i];
        }
        if (end > size) {
            return fmt::format(
                "is truncated ({} of {} bytes), or the program that wrote it did not close it; "
                "copy "
                "or write it again",
                size, end);
        }
        return "is damaged, or the program that wrote it did not close it; copy or write it again";
    }
    return "is not an HDF5 file, or is damaged: it has no HDF5 signature";
}

namespace {

constexpr std::size_t kDeepestGroup = 32, kMostLinks = 1000000;

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

// Adds the datasets for which soft links stand, directly or by a group in their path.
void add_linked(const Hdf5Walk& walk, std::vector<std::pair<std::string, std::string>>& all) {
    for (const auto& [path, target] : walk.links) {
        for (const std::string& dataset : walk.datasets) {
            if (dataset == target || dataset.starts_with(target + "/")) {
                all.emplace_back(path + dataset.substr(target.size()), dataset);
            }
        }
    }
}

}  // namespace

Hdf5Index::Hdf5Index(const std::string& path, bool rows)
    : path_(path),
      rows_(rows),
      file_(H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose, path) {
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
    add_linked(walk, all);
    groups_ = std::move(walk.group_paths);
    const auto in_signals = [](const auto& one) { return one.first.starts_with("signals/"); };
    base_ = std::ranges::any_of(all, in_signals) ? "signals/" : "";
    for (const auto& [name, dataset] : all) {
        datasets_.emplace(shown_name(name), Dataset{dataset});
    }
    for (const std::string& link : walk.elsewhere) {
        datasets_.emplace(shown_name(link), Dataset{"", Content::elsewhere, {}});
    }
    for (const auto& [name, dataset] : datasets_) {
        names_.push_back(name);
    }
}

std::string Hdf5Index::shown_name(const std::string& path) const {
    return !base_.empty() && path.starts_with(base_) ? path.substr(base_.size()) : path;
}

const Hdf5Index::Dataset& Hdf5Index::inspected(const std::string& name) const {
    Dataset& dataset = datasets_.at(name);
    if (dataset.content) {
        return dataset;
    }
    const Hdf5Handle opened(H5Dopen2(file_.get(), dataset.path.c_str(), H5P_DEFAULT), H5Dclose,
                            name);
    const Hdf5Handle created(H5Dget_create_plist(opened.get()), H5Pclose, name);
    if (H5Pget_external_count(created.get()) > 0 || H5Pget_layout(created.get()) == H5D_VIRTUAL) {
        dataset.content = Content::elsewhere;
        return dataset;
    }
    const Hdf5Handle type(H5Dget_type(opened.get()), H5Tclose, name);
    const Hdf5Handle space(H5Dget_space(opened.get()), H5Sclose, name);
    const H5T_class_t kind = H5Tget_class(type.get());
    dataset.content = kind == H5T_FLOAT || kind == H5T_INTEGER ? Content::numbers
                      : kind == H5T_STRING                     ? Content::text
                      : kind == H5T_COMPOUND                   ? Content::compound
                                                               : Content::other;
    const int rank = H5Sget_simple_extent_ndims(space.get());
    check(rank, name);
    dataset.shape.resize(static_cast<std::size_t>(rank));
    check(H5Sget_simple_extent_dims(space.get(), dataset.shape.data(), nullptr), name);
    return dataset;
}

bool Hdf5Index::is_signal(const Dataset& dataset) const {
    if (dataset.content != Content::numbers) {
        return false;
    }
    const auto form = signal_form(dataset.shape);
    return rows_ ? dataset.shape.size() == 2 : form && !form->columns;
}

std::vector<std::string> Hdf5Index::signals() const {
    std::vector<std::string> all;
    std::ranges::copy_if(names_, std::back_inserter(all),
                         [&](const std::string& name) { return is_signal(inspected(name)); });
    return all;
}

std::size_t Hdf5Index::signals_in(const std::string& group) const {
    return static_cast<std::size_t>(std::ranges::count_if(names_, [&](const std::string& name) {
        if (group_of(name, '/') != group || !is_signal(inspected(name))) {
            return false;
        }
        const Shape& shape = inspected(name).shape;
        return std::ranges::any_of(shape, [](hsize_t size) { return size > 1; });
    }));
}

std::vector<std::pair<std::string, double>> Hdf5Index::scalars_in(const std::string& group) const {
    std::vector<std::pair<std::string, double>> scalars;
    for (const std::string& name : names_) {
        if (group_of(name, '/') != group || !stated_rate_Hz({leaf_of(name, '/'), 1.0})) {
            continue;
        }
        const Dataset& dataset = inspected(name);
        const bool single = std::ranges::all_of(dataset.shape, [](hsize_t n) { return n == 1; });
        if (dataset.content == Content::numbers && single) {
            const Numbers numbers = read_numbers(file_.get(), dataset.path, 1);
            scalars.emplace_back(name, numbers.values.front());
        }
    }
    return scalars;
}

std::string Hdf5Index::text_of(const std::string& name) const {
    const Dataset& dataset = inspected(name);
    const std::string shown = printable(name), shape = shape_text(dataset.shape);
    switch (*dataset.content) {
        case Content::text:
            return shown + " (text)";
        case Content::compound:
            return shown + " (compound)";
        case Content::other:
            return shown + " (not numbers)";
        case Content::elsewhere:
            return shown + " (in another file)";
        case Content::numbers:
            break;
    }
    const auto form = signal_form(dataset.shape);
    if (!rows_ && form && form->columns) {
        return fmt::format("{} ({}; {}:1 to {}:{})", shown, shape, shown, shown,
                           dataset.shape[*form->columns]);
    }
    return dataset.shape.empty() ? shown + " (one number)" : fmt::format("{} ({})", shown, shape);
}

std::string Hdf5Index::contents() const {
    constexpr std::size_t kDescribed = 20;
    std::vector<std::string> texts;
    for (const std::string& name : names_) {
        texts.push_back(texts.size() < kDescribed ? text_of(name) : "");
    }
    return listed_text(texts);
}

std::vector<std::string> Hdf5Index::matching(const ColumnChoice& choice) const {
    ColumnChoice plain = choice;
    plain.name.erase(0, plain.name.find_first_not_of('/'));
    std::vector<std::string> found = matching_columns(names_, plain, '/');
    if (found.empty() && !base_.empty() && plain.name.starts_with(base_)) {
        plain.name.erase(0, base_.size());
        found = matching_columns(names_, plain, '/');
    }
    return found;
}

std::string Hdf5Index::problem_of(const std::string& name) const {
    const auto part = matrix_column(name);
    const bool column = !datasets_.contains(name) && part;
    const std::string whole = column ? part->matrix : name;
    const Dataset& dataset = inspected(whole);
    if (dataset.content == Content::elsewhere) {
        return fmt::format(
            "{} is stored in another file (by a link, or external or virtual storage), which is "
            "not supported; copy it into this file, for example with h5copy or h5py's group.copy",
            whole);
    }
    if (dataset.content != Content::numbers) {
        return fmt::format("{} is not a column of numbers", text_of(whole));
    }
    if (rows_ && !column) {
        return dataset.shape.size() == 2 ? ""
                                         : fmt::format("{} has no rows: its shape is {}", name,
                                                       shape_text(dataset.shape));
    }
    const auto form = signal_form(dataset.shape);
    if (!form) {
        return fmt::format(
            "{} has the shape {}; a column must be a vector, or a column of a matrix "
            "whose longer dimension is time",
            whole, shape_text(dataset.shape));
    }
    const std::size_t columns = form->columns ? dataset.shape[*form->columns] : 0;
    if (column && (part->column < 1 || part->column > std::max<std::size_t>(columns, 1))) {
        return fmt::format("{}: {} has {} columns, counted from 1", name, whole,
                           std::max<std::size_t>(columns, 1));
    }
    if (!column && columns > 0) {
        return fmt::format("{} is a matrix of {}; choose one of its columns, {}:1 to {}:{}", name,
                           shape_text(dataset.shape), name, name, columns);
    }
    return "";
}

std::size_t Hdf5Index::columns_of(const std::string& matrix) const {
    if (!datasets_.contains(matrix)) {
        return 0;
    }
    const Dataset& dataset = inspected(matrix);
    const auto form = signal_form(dataset.shape);
    return form && form->columns ? dataset.shape[*form->columns] : 0;
}

std::vector<double> Hdf5Index::read(const std::string& name, std::optional<std::size_t> row,
                                    std::size_t most_values) const {
    const auto part = matrix_column(name);
    const bool column = !datasets_.contains(name) && part;
    const Dataset& dataset = inspected(column ? part->matrix : name);
    Shape start(dataset.shape.size(), 0), count = dataset.shape;
    const auto form = signal_form(dataset.shape);
    if (row) {
        if (*row >= dataset.shape.at(0)) {
            throw SignalError(
                fmt::format("{}: {} has {} rows, but row {} is requested (counted from 0)", path_,
                            printable(name), dataset.shape[0], *row));
        }
        start[0] = *row;
        count[0] = 1;
    } else if (column && form && form->columns) {
        start[*form->columns] = part->column - 1;
        count[*form->columns] = 1;
    }
    std::size_t values = 1;
    for (const hsize_t size : count) {
        if (size > most_values || values * size > most_values) {
            throw Hdf5Error(name);
        }
        values *= size;
    }
    const Hdf5Handle opened(H5Dopen2(file_.get(), dataset.path.c_str(), H5P_DEFAULT), H5Dclose,
                            name);
    const Hdf5Handle space(H5Dget_space(opened.get()), H5Sclose, name);
    if (!count.empty()) {
        check(H5Sselect_hyperslab(space.get(), H5S_SELECT_SET, start.data(), nullptr, count.data(),
                                  nullptr),
              name);
    }
    const hsize_t length = values;
    const Hdf5Handle memory(H5Screate_simple(1, &length, nullptr), H5Sclose, name);
    std::vector<double> read(values);
    check(H5Dread(opened.get(), H5T_NATIVE_DOUBLE, memory.get(), space.get(), H5P_DEFAULT,
                  read.data()),
          name);
    return read;
}

std::vector<Hdf5Attribute> Hdf5Index::attributes(const std::string& name) const {
    const auto part = matrix_column(name);
    const bool column = !datasets_.contains(name) && part;
    const Dataset& dataset = datasets_.at(column ? part->matrix : name);
    const Hdf5Handle opened(H5Dopen2(file_.get(), dataset.path.c_str(), H5P_DEFAULT), H5Dclose,
                            name);
    return attributes_of(opened.get());
}

std::vector<Hdf5Attribute> Hdf5Index::group_attributes(const std::string& group) const {
    // The group of a name at the top is /signals, if it exists.
    const std::string inner = group_of(base_ + group + (group.empty() ? "" : "/"), '/');
    const std::string& path = groups_.contains(inner) ? inner : group;
    if (path.empty()) {
        return root_attributes();
    }
    return groups_.contains(path) ? attributes_of(open_group(file_.get(), path).get())
                                  : std::vector<Hdf5Attribute>();
}

std::vector<Hdf5Attribute> Hdf5Index::root_attributes() const {
    return attributes_of(open_group(file_.get(), "/").get());
}

}  // namespace gearpod::mc
