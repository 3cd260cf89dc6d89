#include "mc/files/hdf5_data.hpp"

#include <algorithm>
#include <initializer_list>
#include <limits>

namespace gearpod::mc {
namespace {

constexpr unsigned kOrdered = H5P_CRT_ORDER_TRACKED | H5P_CRT_ORDER_INDEXED;

// Creation times are not stored, because equal results must give equal files.
Hdf5Handle ordered_properties(hid_t kind, const std::string& attempted) {
    Hdf5Handle properties(H5Pcreate(kind), H5Pclose, attempted);
    if (kind != H5P_DATASET_CREATE) {
        check(H5Pset_link_creation_order(properties.get(), kOrdered), attempted);
    }
    if (kind != H5P_FILE_CREATE) {
        check(H5Pset_obj_track_times(properties.get(), false), attempted);
    }
    check(H5Pset_attr_creation_order(properties.get(), kOrdered), attempted);
    return properties;
}

Hdf5Handle text_type() {
    Hdf5Handle type(H5Tcopy(H5T_C_S1), H5Tclose, "text type");
    check(H5Tset_size(type.get(), H5T_VARIABLE), "text type");
    check(H5Tset_cset(type.get(), H5T_CSET_UTF8), "text type");
    return type;
}

Hdf5Handle space_of(const Shape& shape, const std::string& name) {
    return {H5Screate_simple(static_cast<int>(shape.size()), shape.data(), nullptr), H5Sclose,
            name};
}

Hdf5Handle create_dataset(hid_t parent, const std::string& name, const Shape& shape, hid_t stored,
                          const Hdf5Handle& properties) {
    return {H5Dcreate2(parent, name.c_str(), stored, space_of(shape, name).get(), H5P_DEFAULT,
                       properties.get(), H5P_DEFAULT),
            H5Dclose, name};
}

void write_dataset(hid_t parent, const std::string& name, const Shape& shape, hid_t stored,
                   hid_t given, const void* values) {
    const Hdf5Handle properties = ordered_properties(H5P_DATASET_CREATE, name);
    const Hdf5Handle dataset = create_dataset(parent, name, shape, stored, properties);
    check(H5Dwrite(dataset.get(), given, H5S_ALL, H5S_ALL, H5P_DEFAULT, values), name);
}

void write_attribute(hid_t parent, const std::string& object, const std::string& name, hid_t stored,
                     hid_t given, const void* value) {
    const Hdf5Handle space(H5Screate(H5S_SCALAR), H5Sclose, name);
    const Hdf5Handle attribute(
        H5Acreate_by_name(parent, object.c_str(), name.c_str(), stored, space.get(), H5P_DEFAULT,
                          H5P_DEFAULT, H5P_DEFAULT),
        H5Aclose, name);
    check(H5Awrite(attribute.get(), given, value), name);
}

Hdf5Handle open_scalar(hid_t parent, const std::string& object, const std::string& name,
                       std::initializer_list<H5T_class_t> kinds) {
    Hdf5Handle attribute(
        H5Aopen_by_name(parent, object.c_str(), name.c_str(), H5P_DEFAULT, H5P_DEFAULT), H5Aclose,
        name);
    const Hdf5Handle space(H5Aget_space(attribute.get()), H5Sclose, name);
    const Hdf5Handle type(H5Aget_type(attribute.get()), H5Tclose, name);
    if (H5Sget_simple_extent_npoints(space.get()) != 1 ||
        std::ranges::count(kinds, H5Tget_class(type.get())) == 0) {
        throw Hdf5Error(name);
    }
    return attribute;
}

// Calls a function of the C library twice to get a name: first its length, then its characters.
template <class Get>
std::string counted_name(Get get) {
    const ssize_t length = get(nullptr, 0);
    check(length < 0 ? -1 : 0, "names");
    std::string name(static_cast<std::size_t>(length) + 1, '\0');
    check(get(name.data(), name.size()) < 0 ? -1 : 0, "names");
    name.pop_back();
    return name;
}

void end_printing() {
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
}

}  // namespace

Hdf5Handle open_file(const std::string& path, const std::string& attempted) {
    end_printing();
    return {H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose, attempted};
}

bool is_hdf5(const std::string& path) {
    end_printing();
    return H5Fis_hdf5(path.c_str()) > 0;
}

Hdf5Handle open_dataset(hid_t parent, const std::string& name) {
    return {H5Dopen2(parent, name.c_str(), H5P_DEFAULT), H5Dclose, name};
}

Shape shape_of(const Hdf5Handle& dataset, const std::string& name, std::size_t most_values) {
    const Hdf5Handle space(H5Dget_space(dataset.get()), H5Sclose, name);
    const int rank = H5Sget_simple_extent_ndims(space.get());
    check(rank, name);
    Shape shape(static_cast<std::size_t>(rank));
    check(H5Sget_simple_extent_dims(space.get(), shape.data(), nullptr), name);
    count_of(shape, most_values, name);
    return shape;
}

std::size_t count_of(const Shape& shape, std::size_t most_values, const std::string& name) {
    std::size_t count = 1;
    for (const hsize_t size : shape) {
        if (size > most_values || count * size > most_values) {
            throw Hdf5Error(name);
        }
        count *= size;
    }
    return count;
}

Hdf5Handle create_memory_file() {
    end_printing();
    const Hdf5Handle creation = ordered_properties(H5P_FILE_CREATE, "file");
    const Hdf5Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose, "file");
    constexpr std::size_t increment = std::size_t{1} << 20;
    check(H5Pset_fapl_core(access.get(), increment, false), "file");
    return {H5Fcreate("gearpod-results", H5F_ACC_TRUNC, creation.get(), access.get()), H5Fclose,
            "file"};
}

Hdf5Handle create_file(const std::string& path, hsize_t user_block) {
    end_printing();
    const Hdf5Handle creation = ordered_properties(H5P_FILE_CREATE, "file");
    check(H5Pset_userblock(creation.get(), user_block), "file");
    return {H5Fcreate(path.c_str(), H5F_ACC_TRUNC, creation.get(), H5P_DEFAULT), H5Fclose, "file"};
}

std::uint64_t create_column(hid_t parent, const std::string& name, const Shape& shape,
                            ColumnKind kind) {
    const Hdf5Handle properties = ordered_properties(H5P_DATASET_CREATE, name);
    check(H5Pset_alloc_time(properties.get(), H5D_ALLOC_TIME_EARLY), name);
    check(H5Pset_fill_time(properties.get(), H5D_FILL_TIME_NEVER), name);
    const Hdf5Handle dataset =
        create_dataset(parent, name, shape,
                       kind == ColumnKind::numbers ? H5T_IEEE_F64LE : H5T_STD_I64LE, properties);
    const haddr_t place = H5Dget_offset(dataset.get());
    if (place == HADDR_UNDEF && count_of(shape) > 0) {
        throw Hdf5Error(name);
    }
    return place == HADDR_UNDEF ? 0 : place;
}

std::vector<std::byte> file_bytes(const Hdf5Handle& file) {
    check(H5Fflush(file.get(), H5F_SCOPE_GLOBAL), "file image");
    const ssize_t size = H5Fget_file_image(file.get(), nullptr, 0);
    check(size < 0 ? -1 : 0, "file image");
    std::vector<std::byte> bytes(static_cast<std::size_t>(size));
    check(H5Fget_file_image(file.get(), bytes.data(), bytes.size()) == size ? 0 : -1, "file image");
    return bytes;
}

Hdf5Handle create_group(hid_t parent, const std::string& name) {
    const Hdf5Handle properties = ordered_properties(H5P_GROUP_CREATE, name);
    return {H5Gcreate2(parent, name.c_str(), H5P_DEFAULT, properties.get(), H5P_DEFAULT), H5Gclose,
            name};
}

void write_numbers(hid_t parent, const std::string& name, const Shape& shape,
                   const std::vector<double>& values) {
    write_dataset(parent, name, shape, H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, values.data());
}

void write_integers(hid_t parent, const std::string& name, const Shape& shape,
                    const std::vector<std::int64_t>& values) {
    write_dataset(parent, name, shape, H5T_STD_I64LE, H5T_NATIVE_INT64, values.data());
}

void write_text(hid_t parent, const std::string& object, const std::string& name,
                const std::string& text) {
    const char* pointer = text.c_str();
    write_attribute(parent, object, name, text_type().get(), text_type().get(), &pointer);
}

void write_number(hid_t parent, const std::string& object, const std::string& name, double value) {
    write_attribute(parent, object, name, H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, &value);
}

Hdf5Handle open_group(hid_t parent, const std::string& name) {
    return {H5Gopen2(parent, name.c_str(), H5P_DEFAULT), H5Gclose, name};
}

bool has_soft_links(hid_t root) {
    const auto is_soft = [](hid_t, const char*, const H5L_info_t* link, void*) -> herr_t {
        return link->type == H5L_TYPE_HARD ? 0 : 1;
    };
    const herr_t found = H5Lvisit(root, H5_INDEX_NAME, H5_ITER_NATIVE, is_soft, nullptr);
    check(found, "names");
    return found > 0;
}

std::vector<std::string> link_names(hid_t group) {
    H5G_info_t info{};
    check(H5Gget_info(group, &info), "names");
    std::vector<std::string> names;
    for (hsize_t i = 0; i < info.nlinks; ++i) {
        names.push_back(counted_name([&](char* buffer, std::size_t size) {
            return H5Lget_name_by_idx(group, ".", H5_INDEX_CRT_ORDER, H5_ITER_INC, i, buffer, size,
                                      H5P_DEFAULT);
        }));
    }
    return names;
}

std::vector<std::string> attribute_names(hid_t object) {
    H5O_info_t info{};
    check(H5Oget_info2(object, &info, H5O_INFO_NUM_ATTRS), "names");
    std::vector<std::string> names;
    for (hsize_t i = 0; i < info.num_attrs; ++i) {
        names.push_back(counted_name([&](char* buffer, std::size_t size) {
            return H5Aget_name_by_idx(object, ".", H5_INDEX_CRT_ORDER, H5_ITER_INC, i, buffer, size,
                                      H5P_DEFAULT);
        }));
    }
    return names;
}

Numbers read_numbers(hid_t parent, const std::string& name, std::size_t most_values) {
    const Hdf5Handle dataset = open_dataset(parent, name);
    Numbers numbers;
    numbers.shape = shape_of(dataset, name, most_values);
    numbers.values.resize(count_of(numbers.shape));
    check(H5Dread(dataset.get(), H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT,
                  numbers.values.data()),
          name);
    return numbers;
}

std::vector<std::int64_t> read_integers(hid_t parent, const std::string& name,
                                        std::size_t most_values) {
    const Hdf5Handle dataset = open_dataset(parent, name);
    std::vector<std::int64_t> values(count_of(shape_of(dataset, name, most_values)));
    check(H5Dread(dataset.get(), H5T_NATIVE_INT64, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()),
          name);
    return values;
}

std::size_t row_count(hid_t parent, const std::string& name) {
    const Hdf5Handle dataset = open_dataset(parent, name);
    const Shape shape =
        shape_of(dataset, name, static_cast<std::size_t>(std::numeric_limits<hssize_t>::max()));
    if (shape.size() != 1) {
        throw Hdf5Error(name);
    }
    return shape[0];
}

template <class Value>
void read_rows(hid_t parent, const std::string& name, const Shape& shape, RowRange range,
               std::vector<Value>& values) {
    const Hdf5Handle dataset = open_dataset(parent, name);
    if (shape_of(dataset, name, count_of(shape)) != shape) {
        throw Hdf5Error(name);
    }
    Shape start(shape.size(), 0), count = shape;
    start[0] = range.first;
    count[0] = range.count;
    values.resize(count_of(count));
    const Hdf5Handle space(H5Dget_space(dataset.get()), H5Sclose, name);
    check(H5Sselect_hyperslab(space.get(), H5S_SELECT_SET, start.data(), nullptr, count.data(),
                              nullptr),
          name);
    check(
        H5Dread(dataset.get(), std::is_same_v<Value, double> ? H5T_NATIVE_DOUBLE : H5T_NATIVE_INT64,
                space_of(count, name).get(), space.get(), H5P_DEFAULT, values.data()),
        name);
}

template void read_rows(hid_t, const std::string&, const Shape&, RowRange, std::vector<double>&);
template void read_rows(hid_t, const std::string&, const Shape&, RowRange,
                        std::vector<std::int64_t>&);

bool has_text(hid_t object, const std::string& name) {
    const Hdf5Handle attribute(H5Aopen(object, name.c_str(), H5P_DEFAULT), H5Aclose, name);
    const Hdf5Handle space(H5Aget_space(attribute.get()), H5Sclose, name);
    const Hdf5Handle type(H5Aget_type(attribute.get()), H5Tclose, name);
    return H5Sget_simple_extent_npoints(space.get()) == 1 &&
           H5Tget_class(type.get()) == H5T_STRING && H5Tis_variable_str(type.get()) > 0;
}

std::string read_text(hid_t parent, const std::string& object, const std::string& name) {
    const Hdf5Handle attribute = open_scalar(parent, object, name, {H5T_STRING});
    const Hdf5Handle stored(H5Aget_type(attribute.get()), H5Tclose, name);
    if (H5Tis_variable_str(stored.get()) <= 0) {
        throw Hdf5Error(name);
    }
    char* pointer = nullptr;
    check(H5Aread(attribute.get(), text_type().get(), &pointer), name);
    const std::string text = pointer == nullptr ? "" : pointer;
    H5free_memory(pointer);
    return text;
}

double read_number(hid_t parent, const std::string& object, const std::string& name) {
    const Hdf5Handle attribute = open_scalar(parent, object, name, {H5T_FLOAT, H5T_INTEGER});
    double value = 0.0;
    check(H5Aread(attribute.get(), H5T_NATIVE_DOUBLE, &value), name);
    return value;
}

}  // namespace gearpod::mc
