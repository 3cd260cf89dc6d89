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
    RowBlock block;
    block.first = range.first;
    std::vector<std::int64_t> integers;
    read_rows(root, "instances/group", {rows}, range, integers);
    block.group.assign(integers.begin(), integers.end());
    read_rows(root, "status", {rows}, range, integers);
    block.status.assign(integers.begin(), integers.end());
    block.values.resize(range.count * row_shape(frame).values());
    std::vector<double> values;
    for_each_column(frame, [&](const auto& column) {
        read_rows(root, column.dataset, column.by_level ? Shape{rows, column.width} : Shape{rows},
                  range, values);
        block.put(values.data(), column.first, column.width);
    });
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
