#include "mc/files/sha256.hpp"

#include <fmt/format.h>
#include <openssl/evp.h>

#include <array>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <stdexcept>

namespace gearpod::mc {
namespace {

class Hash {
  public:
    Hash() { check(EVP_DigestInit_ex(context_.get(), EVP_sha256(), nullptr)); }
    void add(std::string_view bytes) {
        check(EVP_DigestUpdate(context_.get(), bytes.data(), bytes.size()));
    }
    // Nothing may be added afterwards.
    std::string hex() {
        std::array<unsigned char, 32> digest;
        check(EVP_DigestFinal_ex(context_.get(), digest.data(), nullptr));
        return fmt::format("{:02x}", fmt::join(digest, ""));
    }

  private:
    static void check(int succeeded) {
        if (succeeded != 1) {
            throw std::runtime_error("SHA-256 is not available");
        }
    }

    std::unique_ptr<EVP_MD_CTX, void (*)(EVP_MD_CTX*)> context_{EVP_MD_CTX_new(), EVP_MD_CTX_free};
};

}  // namespace

std::string sha256(std::string_view bytes) {
    Hash hash;
    hash.add(bytes);
    return hash.hex();
}

std::string file_sha256(const std::string& path) {
    // Reading a pipe or a device might never end.
    if (std::error_code error; !std::filesystem::is_regular_file(path, error)) {
        return "";
    }
    const std::unique_ptr<FILE, int (*)(FILE*)> file(std::fopen(path.c_str(), "rb"), std::fclose);
    if (!file) {
        return "";
    }
    Hash hash;
    std::array<char, 65536> buffer;
    while (const std::size_t count = std::fread(buffer.data(), 1, buffer.size(), file.get())) {
        hash.add({buffer.data(), count});
    }
    return std::ferror(file.get()) != 0 ? "" : hash.hex();
}

}  // namespace gearpod::mc
