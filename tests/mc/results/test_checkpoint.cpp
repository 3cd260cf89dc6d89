// Checks the checkpoint: written data are read again, damaged or foreign data are detected.
#include <fcntl.h>
#include <sys/stat.h>
#include <sys/wait.h>

#include "mc/results/checkpoint.hpp"
#include "tests/mc/results/small_results.hpp"

namespace gearpod::mc::test_checkpoint {

using namespace test;

const RowShape kShape{2, 2, 3};
const RunIdentity kIdentity{"gearpod 1 (git abc)", "7", "[ensemble]\nseed = 7\n", kShape};
const BatchPlan kPlan(20, 42);  // batches of 16, 4, 16, 16, 10

BatchRows rows_of(const BatchPlan& plan, std::size_t batch) {
    BatchRows rows;
    for (std::size_t row = 0; row < plan.batch(batch).rows(); ++row) {
        rows.status.push_back(static_cast<int>(row % 3));
        for (std::size_t value = 0; value < kShape.values(); ++value) {
            rows.values.push_back(100.0 * static_cast<double>(plan.batch(batch).first_row + row) +
                                  0.1 * static_cast<double>(value));
        }
    }
    rows.values.back() = std::numeric_limits<double>::quiet_NaN();
    return rows;
}

bool same(const BatchRows& a, const BatchRows& b) {
    return a.status == b.status && bits_of(a.values) == bits_of(b.values);
}

void fill(const std::string& path, const std::vector<std::size_t>& batches) {
    const auto checkpoint = Checkpoint::create(path, kIdentity, kPlan);
    for (const std::size_t batch : batches) {
        checkpoint->write(batch, rows_of(kPlan, batch));
    }
    checkpoint->sync();
}

std::string reason_of(const std::string& path, const RunIdentity& identity = kIdentity,
                      const BatchPlan& plan = kPlan) {
    return message_of([&] { Checkpoint::resume(path, identity, plan); });
}

TEST_CASE(
    "A plan's batches hold every row once, with the threshold group and test gearboxes in "
    "separate batches") {
    std::size_t row = 0;
    for (std::size_t batch = 0; batch < kPlan.batches(); ++batch) {
        CHECK(kPlan.rows_before(batch) == row);
        const Batch place = kPlan.batch(batch);
        CHECK(place.first_row == row);
        CHECK(place.first_index == (row < 20 ? row : row - 20));
        for (std::size_t i = 0; i < place.rows(); ++i, ++row) {
            CHECK(kPlan.batch_of_row(row) == batch);
            CHECK((place.group == Group::threshold) == (row < 20));
        }
    }
    CHECK(row == 62);
    CHECK(kPlan.rows_before(kPlan.batches()) == 62);
    CHECK(kPlan.batches() == 5);
}

TEST_CASE("Records of a gearbox are rows of its batch") {
    const BatchPlan plan(20, 42, {}, 7);
    CHECK(plan.threshold_rows() == 140);
    CHECK(plan.threshold_gearboxes() == 20);
    CHECK(plan.rows() == 182);
    CHECK(plan.batch(0).rows() == 112);
    CHECK(plan.batch(1).first_index == 16);
    CHECK(plan.batch(1).rows() == 28);
    CHECK(plan.batch(2).rows() == 16);

    const auto [folder, path] = TemporaryFile("a.h5.checkpoint");
    {
        const auto checkpoint = Checkpoint::create(path, kIdentity, plan);
        for (const std::size_t batch : {4, 0, 2, 1}) {
            checkpoint->write(batch, rows_of(plan, batch));
        }
        checkpoint->sync();
    }
    const auto resumed = Checkpoint::resume(path, kIdentity, plan);
    CHECK(resumed->findings().empty());
    for (const std::size_t batch : {0, 1, 2, 4}) {
        CHECK(same(resumed->read(batch), rows_of(plan, batch)));
    }
    CHECK(!resumed->has(3));
}

TEST_CASE("Parts of a plan hold every batch of the whole once, each with its own rows") {
    const int records = GENERATE(1, 5);
    for (const auto& [thresholds, test] : {std::pair{20, 42}, {35, 50}, {16, 16}, {3, 2}}) {
        const BatchPlan whole(thresholds, test, {}, records);
        for (const std::size_t count : {1, 2, 3, 4, 7}) {
            std::size_t batches = 0, rows = 0, threshold_rows = 0;
            for (std::size_t index = 0; index < count; ++index) {
                const BatchPlan own(thresholds, test, {index, count}, records);
                std::size_t row = 0;
                for (std::size_t batch = 0; batch < own.batches(); ++batch) {
                    const Batch place = own.batch(batch), all = whole.batch(own.number(batch));
                    CHECK(place.group == all.group);
                    CHECK(place.first_index == all.first_index);
                    CHECK(place.rows() == all.rows());
                    CHECK(place.first_row == row);
                    for (std::size_t i = 0; i < place.rows(); ++i, ++row) {
                        CHECK(own.batch_of_row(row) == batch);
                    }
                    CHECK((batch < own.threshold_batches()) == (all.group == Group::threshold));
                }
                CHECK(own.rows() == row);
                CHECK(own.threshold_rows() + own.test_rows() == row);
                batches += own.batches();
                rows += row;
                threshold_rows += own.threshold_rows();
            }
            CHECK(batches == whole.batches());
            CHECK(rows == whole.rows());
            CHECK(threshold_rows == whole.threshold_rows());
        }
    }
    CHECK(read_part("2/4") == Part{1, 4});
    CHECK(read_part("")->whole());
    CHECK(Part{1, 4}.text() == "2/4");
    CHECK(!read_part("0/4"));
    CHECK(!read_part("5/4"));
    CHECK(!read_part("-1/4"));
}

TEST_CASE("Finished batches are read again, in any order of writing") {
    const auto [folder, path] = TemporaryFile("r.h5.part");
    fill(path, {4, 0, 2});
    const auto checkpoint = Checkpoint::resume(path, kIdentity, kPlan);
    CHECK(checkpoint->findings().empty());
    CHECK(checkpoint->batches_done() == 3);
    for (std::size_t batch = 0; batch < kPlan.batches(); ++batch) {
        CHECK(checkpoint->has(batch) == (batch == 0 || batch == 2 || batch == 4));
        if (checkpoint->has(batch)) {
            CHECK(same(checkpoint->read(batch), rows_of(kPlan, batch)));
        }
    }
    checkpoint->remove();
    CHECK(folder.empty());
}

TEST_CASE("A larger ensemble keeps all batches except the one that it fills") {
    const auto [folder, path] = TemporaryFile("r.h5.part");
    fill(path, {0, 1, 2, 3, 4});
    const BatchPlan larger(20, 80);
    const auto checkpoint = Checkpoint::resume(path, kIdentity, larger);
    CHECK(checkpoint->findings().empty());
    for (std::size_t batch = 0; batch < larger.batches(); ++batch) {
        CHECK(checkpoint->has(batch) == (batch < 4));
    }
    CHECK(contains(reason_of(path, kIdentity, BatchPlan(20, 40)), "80 test gearboxes"));
}

TEST_CASE("Another study, seed or version is refused with the reason") {
    const Folder folder;
    const std::string path = folder.file("r.h5.part");
    fill(path, {0, 1});
    RunIdentity other = kIdentity;
    other.version = "gearpod 2 (git def)";
    CHECK(contains(reason_of(path, other), "r.h5.part: was made by gearpod 1 (git abc)"));
    other = kIdentity;
    other.seed = "8";
    CHECK(contains(reason_of(path, other), "has seed 7, this run has 8"));
    other = kIdentity;
    other.study += "instances = 3\n";
    CHECK(contains(reason_of(path, other), "another study (\"nothing\" there, \"instances = 3\""));
    CHECK(reason_of(path).empty());
    CHECK(contains(message_of([&] { Checkpoint::create(path, kIdentity, kPlan); }), "--resume"));
    CHECK(reason_of(path).empty());
}

TEST_CASE("Two runs cannot use one checkpoint at the same time") {
    const Folder folder;
    const std::string path = folder.file("r.h5.part");
    const auto mine = Checkpoint::create(path, kIdentity, kPlan);
    const pid_t other = fork();
    if (other == 0) {
        std::array<char, 64> host{};
        ::gethostname(host.data(), host.size() - 1);
        const std::string worker = "r.h5.part: another run (process " + std::to_string(getppid()) +
                                   " on " + host.data() + " since 20";
        const std::string created = message_of([&] { Checkpoint::create(path, kIdentity, kPlan); });
        const std::string resumed = reason_of(path);
        const bool good = contains(resumed, worker) && contains(created, worker) &&
                          contains(created, "is using it") && !contains(created, "delete");
        std::_Exit(good ? 0 : 1);
    }
    int status = 0;
    REQUIRE(waitpid(other, &status, 0) == other);
    CHECK(status == 0);
}

// One of many simultaneous runs creates the checkpoint, and all others report its owner.
TEST_CASE("Only one of several competing runs gets a checkpoint") {
    const Folder folder;
    for (int round = 0; round < 20; ++round) {
        const std::string path = folder.file("r" + std::to_string(round) + ".part");
        std::array<int, 2> gate{};
        REQUIRE(::pipe(gate.data()) == 0);
        std::vector<pid_t> starters;
        for (int i = 0; i < 6; ++i) {
            starters.push_back(fork());
            if (starters.back() == 0) {
                char byte = 0;
                ::close(gate[1]);
                static_cast<void>(::read(gate[0], &byte, 1) == 0);  // until all have started
                std::unique_ptr<Checkpoint> mine;
                const std::string error =
                    message_of([&] { mine = Checkpoint::create(path, kIdentity, kPlan); });
                const int code = error.empty() ? 0 : contains(error, "is using it") ? 1 : 2;
                ::usleep(200000);
                std::_Exit(code);
            }
        }
        ::close(gate[0]);
        ::close(gate[1]);
        int made = 0, reported = 0;
        for (const pid_t starter : starters) {
            int status = 0;
            REQUIRE(waitpid(starter, &status, 0) == starter);
            made += WEXITSTATUS(status) == 0 ? 1 : 0;
            reported += WEXITSTATUS(status) == 1 ? 1 : 0;
        }
        CHECK(made == 1);
        CHECK(reported == 5);
    }
    CHECK(folder.files() == 20);
}

TEST_CASE("A checkpoint that is a link or a pipe is refused without blocking") {
    const auto [folder, path] = TemporaryFile("r.h5.part");
    REQUIRE(::mkfifo(path.c_str(), 0600) == 0);
    CHECK(contains(reason_of(path), "is not a regular file"));
    std::filesystem::remove(path);
    fill(folder.file("other"), {0});
    std::filesystem::create_symlink("other", path);
    CHECK(contains(reason_of(path), "cannot be opened"));
}

TEST_CASE("For any damaged byte of a checkpoint no damaged batch is used") {
    const Folder folder;
    const std::string path = folder.file("r.h5.part");
    const std::vector<std::size_t> written{0, 1, 4};  // a full one, and the last of each group
    fill(path, written);
    const std::string bytes = bytes_of(path);
    long refused = 0, found = 0;
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        std::string damaged = bytes;
        damaged[i] = static_cast<char>(damaged[i] ^ (1 << (i % 8)));
        write_bytes(path, damaged);
        std::unique_ptr<Checkpoint> checkpoint;
        if (!message_of([&] { checkpoint = Checkpoint::resume(path, kIdentity, kPlan); }).empty()) {
            ++refused;
            continue;
        }
        std::size_t there = 0;
        for (std::size_t batch = 0; batch < kPlan.batches(); ++batch) {
            if (checkpoint->has(batch)) {
                ++there;
                REQUIRE(same(checkpoint->read(batch), rows_of(kPlan, batch)));
            }
        }
        if (there < written.size()) {
            REQUIRE(there == written.size() - 1);
            REQUIRE(checkpoint->findings().size() == 1);
            REQUIRE(contains(checkpoint->findings()[0], "1 batch is damaged"));
            ++found;
        }
    }
    CHECK(refused > 20);
    CHECK(found == 3 * 1176 / 3);  // every checked byte of every batch
}

TEST_CASE(
    "A truncated checkpoint is resumed with the remaining batches, and the loss is reported") {
    const auto [folder, path] = TemporaryFile("r.h5.part");
    fill(path, {0, 1, 2, 3, 4});
    const std::string bytes = bytes_of(path);
    const std::size_t record = (bytes.size() - 4096) / 5;
    write_bytes(path, bytes.substr(0, 4096 + 2 * record));
    {
        const auto checkpoint = Checkpoint::resume(path, kIdentity, kPlan);
        CHECK(checkpoint->batches_done() == 2);
        REQUIRE(checkpoint->findings().size() == 1);
        CHECK(contains(checkpoint->findings()[0], "3 of 5 batches"));
    }
    write_bytes(path, bytes.substr(0, 4096 + 4 * record + 100));
    {
        const auto checkpoint = Checkpoint::resume(path, kIdentity, kPlan);
        CHECK(checkpoint->batches_done() == 4);
        CHECK(contains(checkpoint->findings()[0], "1 batch is damaged or incomplete"));
    }
    for (const std::size_t length : {std::size_t{0}, std::size_t{10}, std::size_t{60}}) {
        write_bytes(path, bytes.substr(0, length));
        CHECK(contains(reason_of(path), "r.h5.part: is "));
    }
    write_bytes(path, "something else entirely, long enough to be read");
    CHECK(contains(reason_of(path), "is not a checkpoint"));
}

TEST_CASE("A batch at another batch's position is refused") {
    const auto [folder, path] = TemporaryFile("r.h5.part");
    fill(path, {0, 2, 3});
    std::string bytes = bytes_of(path);
    const std::size_t record = (bytes.size() - 4096) / 4;
    bytes.replace(4096 + 2 * record, record, bytes.substr(4096 + 3 * record, record));
    write_bytes(path, bytes);
    const auto checkpoint = Checkpoint::resume(path, kIdentity, kPlan);
    CHECK_FALSE(checkpoint->has(2));
    CHECK(checkpoint->has(3));
    CHECK(checkpoint->findings().size() == 1);
}

TEST_CASE("A full disk is a write error, and earlier batches remain") {
    const Folder folder;
    const std::string path = folder.file("r.h5.part");
    std::size_t batch = 0;
    const std::string reason = message_of_full_disk(4096 + 2000, [&] {
        const auto checkpoint = Checkpoint::create(path, kIdentity, kPlan);
        for (; batch < kPlan.batches(); ++batch) {
            checkpoint->write(batch, rows_of(kPlan, batch));
        }
    });
    CHECK(contains(reason, "r.h5.part: cannot be written (File too large)"));
    REQUIRE(batch > 0);
    const auto checkpoint = Checkpoint::resume(path, kIdentity, kPlan);
    CHECK(checkpoint->batches_done() == batch);
    for (std::size_t t = 0; t < batch; ++t) {
        CHECK(same(checkpoint->read(t), rows_of(kPlan, t)));
    }
}

}  // namespace gearpod::mc::test_checkpoint
