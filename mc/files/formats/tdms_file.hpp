// Channels of a TDMS file of LabVIEW. Source: National Instruments, "TDMS File Format Internal
// Structure".
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "mc/files/formats/tdms_values.hpp"

namespace gearpod::mc {

// Equally spaced values in the file.
struct TdmsBlock {
    std::uint64_t first = 0, stride = 0, count = 0;  // bytes, bytes, values
    TdmsType type = TdmsType::none;
    bool big_endian = false;
};

// Raw values of a channel. DAQmx channels may have several, each with the number of a scale; other
// channels have one.
struct TdmsRaw {
    std::uint32_t scale = 0;
    std::vector<TdmsBlock> blocks;
};

struct TdmsChannel {
    std::string path, group, name;
    TdmsType type = TdmsType::none;
    std::vector<TdmsRaw> raw;
    TdmsProperties properties;
    bool daqmx = false;
};

struct TdmsFile {
    bool closed = true;                 // false if the last segment may lack values
    std::vector<TdmsChannel> channels;  // in the order of the file
    TdmsProperties properties;
    std::map<std::string, TdmsProperties> groups;
};

// Throws SignalError (signal_error.hpp) if the file is damaged, truncated or not a TDMS file.
TdmsFile read_tdms(const std::string& path);

}  // namespace gearpod::mc
