#include "mc/results/file_rows.hpp"

#include <algorithm>
#include <stdexcept>

#include "mc/files/hdf5_data.hpp"
#include "mc/results/layout.hpp"

namespace gearpod::mc {
namespace {

constexpr std::size_t kFileBlockRows = 4096;

Hdf5Handle open_file(const std::string& path) {
    return {H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose, "opening the file"};
}

[[noreturn]] void refuse(const std::string& path, const Hdf5Error& error) {
    throw std::runtime_error(path + ": is damaged or truncated (at \"" + error.what() + "\")");
}

RowBlock read_block(hid_t root, const Results& frame, std::size_t rows, RowRange range) {
    const RowShape shape = row_shape(frame);
    RowBlock block;
    block.first = range.first;
    std::vector<std::int64_t> integers;
    read_rows(root, "instances/group", {rows}, range, integers);
    block.group.assign(integers.begin(), integers.end());
    read_rows(root, "status", {rows}, range, integers);
    block.status.assign(integers.begin(), integers.end());
    block.values.resize(range.count * shape.values());
    std::vector<double> column;
    const auto put = [&](std::size_t at, std::size_t width) {
        for (std::size_t row = 0; row < range.count; ++row) {
            std::copy_n(
                column.begin() + static_cast<std::ptrdiff_t>(row * width), width,
                block.values.begin() + static_cast<std::ptrdiff_t>(row * shape.values() + at));
        }
    };
    for (std::size_t p = 0; p < shape.parameters; ++p) {
        read_rows(root, "instances/" + frame.parameters[p].name, {rows}, range, column);
        put(p, 1);
    }
    for (std::size_t f = 0; f < shape.features; ++f) {
        read_rows(root, "features/" + frame.features[f].name, {rows, shape.levels}, range, column);
        put(shape.value_of(f, 0), shape.levels);
    }
    const auto put_columns = [&](const std::string& group, const std::vector<RowColumn>& columns,
                                 std::size_t at) {
        for (const RowColumn& one : columns) {
            read_rows(root, group + "/" + one.name, {rows}, range, column);
            put(at++, 1);
        }
    };
    put_columns(kContactLoss, frame.contact_loss, shape.contact_loss());
    put_columns(kIntegration, frame.integration, shape.integration_value());
    for (std::size_t v = 0; v < shape.variants; ++v) {
        const Variant& variant = frame.variants[v];
        for (std::size_t f = 0; f < shape.features; ++f) {
            read_rows(root,
                      std::string(kVariants) + "/" + variant.name + "/" + variant.features[f].name,
                      {rows, shape.levels}, range, column);
            put(shape.variant_value_of(v, f), shape.levels);
        }
    }
    return block;
}

}  // namespace

FileRows::FileRows(const std::string& path, const Results& frame) : path_(path), frame_(frame) {
    const SilentHdf5 silent;
    try {
        const Hdf5Handle file = open_file(path);
        rows_ = row_count(file.get(), "status");
    } catch (const Hdf5Error& error) {
        refuse(path, error);
    }
}

void FileRows::visit(const std::function<void(const RowBlock&)>& use) const {
    const SilentHdf5 silent;
    try {
        const Hdf5Handle file = open_file(path_);
        for (std::size_t first = 0; first < rows_; first += kFileBlockRows) {
            use(read_block(file.get(), frame_, rows_,
                           {first, std::min(kFileBlockRows, rows_ - first)}));
        }
    } catch (const Hdf5Error& error) {
        refuse(path_, error);
    }
}

}  // namespace gearpod::mc
