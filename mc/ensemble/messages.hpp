// Messages between ranks: values as bytes. All ranks run the same program on the same kind of
// machine.
#pragma once

#include <cereal/archives/binary.hpp>
#include <cereal/types/optional.hpp>
#include <cereal/types/string.hpp>
#include <cereal/types/vector.hpp>
#include <sstream>
#include <string>
#include <type_traits>

#include "mc/ensemble/batch_workers.hpp"
#include "mc/ensemble/ranks.hpp"

namespace gearpod {

// For structures without lists or texts.
template <class Archive, class Value>
requires(std::is_aggregate_v<Value>&& std::is_trivially_copyable_v<Value>) void serialize(
    Archive& archive, Value& value) {
    archive(cereal::binary_data(reinterpret_cast<char*>(&value), sizeof value));
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

// Sends and receives a structure by its members. The structured binding names all of them, so a new
// one does not compile until it is sent too.
#define GEARPOD_SEND(TYPE, ...)                         \
    template <class Archive>                            \
    void serialize(Archive& archive, TYPE& structure) { \
        auto& [__VA_ARGS__] = structure;                \
        archive(__VA_ARGS__);                           \
    }

GEARPOD_SEND(BatchRows, status, values)
GEARPOD_SEND(FinishedBatch, batch, rows, seconds, failure, stopped)

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
