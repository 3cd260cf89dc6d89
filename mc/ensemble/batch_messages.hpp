// Messages between ranks about batches, encoded as bytes. All ranks run the same program on the
// same kind of machine.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "mc/ensemble/worker_team.hpp"

namespace gearpod::mc {

enum class MessageKind {
    compute,   // to a rank: compute this batch
    drop,      // to a rank: start none of its waiting batches
    cancel,    // to a rank: cancel its batches after this number of milliseconds
    close,     // to a rank: the run is finished
    finished,  // to rank 0: rows of a batch, or its error
    dropped,   // to rank 0: number of batches that were not started
    stop,      // to rank 0: name of a signal received
    times      // to rank 0: times of the threads; the last message of a rank
};

std::vector<std::byte> bytes_of_number(std::size_t number);
std::size_t number_of(std::span<const std::byte> bytes);

std::vector<std::byte> bytes_of_text(const std::string& text);
std::string text_of(std::span<const std::byte> bytes);

std::vector<std::byte> bytes_of_batch(const FinishedBatch& batch);
FinishedBatch batch_of(std::span<const std::byte> bytes);

std::vector<std::byte> bytes_of_times(const TeamTimes& times);
TeamTimes times_of(std::span<const std::byte> bytes);

}  // namespace gearpod::mc
