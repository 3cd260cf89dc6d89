// What ranks say to each other while they share batches, as bytes. All ranks run the same program
// on the same kind of machine.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "mc/ensemble/batch_crew.hpp"

namespace gearpod::mc {

enum class Say {
    compute,   // to a rank: a batch
    drop,      // to a rank: begin no more of its batches
    leave,     // to a rank: leave off its batches in so many milliseconds
    close,     // to a rank: all is done
    finished,  // to rank 0: a batch's rows, or what went wrong
    dropped,   // to rank 0: how many batches were not begun
    stop,      // to rank 0: a signal has come, its name
    times      // to rank 0: what the threads did, the last word
};

std::vector<std::byte> bytes_of_number(std::size_t number);
std::size_t number_of(std::span<const std::byte> bytes);

std::vector<std::byte> bytes_of_text(const std::string& text);
std::string text_of(std::span<const std::byte> bytes);

std::vector<std::byte> bytes_of_batch(const FinishedBatch& batch);
FinishedBatch batch_of(std::span<const std::byte> bytes);

std::vector<std::byte> bytes_of_times(const CrewTimes& times);
CrewTimes times_of(std::span<const std::byte> bytes);

}  // namespace gearpod::mc
