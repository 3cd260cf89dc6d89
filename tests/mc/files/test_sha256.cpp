// Checks SHA-256 with the test vectors of FIPS 180-4.
#include "mc/files/sha256.hpp"
#include "tests/test.hpp"

namespace gearpod::test_sha256 {

TEST_CASE("Hashes are SHA-256 (FIPS 180-4; vectors of NIST's examples)") {
    CHECK(mc::sha256("") == "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
    CHECK(mc::sha256("abc") == "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
    CHECK(mc::sha256("abcdbcdecdefdefgefghfghighijhijkijkljklmklmnlmnomnopnopq") ==
          "248d6a61d20638b8e5c026930c3e6039a33ce45964ff2167f6ecedd419db06c1");
    CHECK(mc::sha256(std::string(1000000, 'a')) ==
          "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0");
    CHECK(mc::file_sha256("/nonexistent/file").empty());
}

}  // namespace gearpod::test_sha256
