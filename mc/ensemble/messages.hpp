// Messages between ranks: values as bytes. All ranks run the same program on the same kind of
// machine.
#pragma once

#include <cereal/archives/binary.hpp>
#include <cereal/types/optional.hpp>
#include <cereal/types/string.hpp>
#include <cereal/types/vector.hpp>
#include <sstream>
#include <string>
#include <tuple>
#include <type_traits>

#include "machine/fields.hpp"
#include "mc/ensemble/batch_workers.hpp"
#include "mc/ensemble/ranks.hpp"

namespace gearpod {

// For structures without lists or texts.
template <class Archive, class Value>
requires(std::is_aggregate_v<Value>&& std::is_trivially_copyable_v<Value>) void serialize(
    Archive& archive, Value& value) {
    archive(cereal::binary_data(reinterpret_cast<char*>(&value), sizeof value));
}

// For all others, by their field tables.
template <class Archive, HasFields Structure>
requires(!std::is_trivially_copyable_v<Structure>) void serialize(Archive& archive,
                                                                  Structure& structure) {
    std::apply([&](auto&... members) { archive(members...); }, fields_of(structure));
}

}  // namespace gearpod

namespace gearpod::mc {

enum class MessageKind {
    compute,   // to a rank: compute this batch
    drop,      // to a rank: start none of its waiting batches
    cancel,    // to a rank: cancel its batches after this number of milliseconds
    close,     // to a rank: the run is finished
    finished,  // to rank 0: rows of a batch, or its error
    dropped,   // to rank 0: number of batches that were not started
    stop,      // to rank 0: name of a signal received
    times,     // to rank 0: times of the threads; the last message about batches
    assessed,  // to rank 0: detection statistics of a machine's share
};

inline void send(const Ranks& ranks, int to, MessageKind what, const std::string& bytes = {}) {
    ranks.send(to, static_cast<int>(what), bytes);
}

using gearpod::serialize;

template <class... Values>
std::string bytes_of(const Values&... values) {
    std::ostringstream stream;
    cereal::BinaryOutputArchive archive(stream);
    archive(values...);
    return std::move(stream).str();
}

// Reads the values of bytes_of() in the same order.
template <class... Values>
void read_bytes(std::string bytes, Values&... values) {
    std::istringstream stream(std::move(bytes));
    cereal::BinaryInputArchive archive(stream);
    archive(values...);
}

template <class Value>
Value value_of(std::string bytes) {
    Value value{};
    read_bytes(std::move(bytes), value);
    return value;
}

}  // namespace gearpod::mc
