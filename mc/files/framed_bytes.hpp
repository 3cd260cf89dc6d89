// Messages between a process and its child over a stream socket: their length, then their bytes.
#pragma once

#include <cstddef>
#include <span>
#include <string>

namespace gearpod::mc {

// Sends one message of both parts. False if the other process has closed the socket.
bool send_framed(int fd, std::span<const char> bytes, std::span<const std::byte> more = {});
// Waits at most `timeout_ms` for each part; -1 waits without limit. False as above, or if the time
// is over.
bool receive_framed(int fd, std::string& bytes, int timeout_ms);

}  // namespace gearpod::mc
