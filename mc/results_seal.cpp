#include "mc/results_seal.hpp"

#include <fstream>
#include <iterator>
#include <string_view>

#include "mc/fnv.hpp"

namespace gearpod::mc {
namespace {

constexpr std::string_view kMark = "gearpod\n";
constexpr std::size_t kSealBytes = 16;

std::string seal_of(std::string_view content) {
    std::string seal(kMark);
    const std::uint64_t sum = fnv1a(content);
    for (int byte = 0; byte < 8; ++byte) {
        seal += static_cast<char>((sum >> (8 * byte)) & 0xff);
    }
    return seal;
}

}  // namespace

void append_seal(std::vector<std::byte>& bytes) {
    const std::string_view content(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    for (const char c : seal_of(content)) {
        bytes.push_back(static_cast<std::byte>(c));
    }
}

Seal check_seal(const std::string& path) {
    std::ifstream stream(path, std::ios::binary);
    const std::string text{std::istreambuf_iterator<char>(stream), {}};
    if (text.size() < kSealBytes) {
        return Seal::missing;
    }
    const std::string_view content(text.data(), text.size() - kSealBytes);
    const std::string_view seal(text.data() + content.size(), kSealBytes);
    if (!seal.starts_with(kMark)) {
        return Seal::missing;
    }
    return seal == seal_of(content) ? Seal::intact : Seal::broken;
}

}  // namespace gearpod::mc
