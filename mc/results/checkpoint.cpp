#include "mc/results/checkpoint.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <ctime>
#include <sstream>
#include <stdexcept>

#include "mc/files/atomic_file.hpp"
#include "mc/study/random/fnv.hpp"

namespace gearpod::mc {
namespace {

constexpr std::string_view kMagic = "gearpod tiles 2\n";
constexpr std::uint64_t kBatchMark = 0x454c495444504721u;  // first number of a written batch
constexpr std::size_t kBlock = 4096;                       // alignment of the first batch
constexpr std::size_t kMostText = 1u << 24;                // longer texts count as damage

constexpr std::size_t kCounterBytes = 24, kWorkerBytes = 256;
// does not follow links and does not wait for a pipe
constexpr int kOpenExisting = O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK;

// Index of the first status in a stored batch, in units of 8 bytes.
constexpr std::size_t kStatusAt = 2;

std::string number_bytes(std::uint64_t number) {
    std::string bytes(sizeof number, '\0');
    std::memcpy(bytes.data(), &number, sizeof number);
    return bytes;
}

std::uint64_t number_at(std::string_view bytes, std::size_t offset) {
    std::uint64_t number = 0;
    std::memcpy(&number, bytes.data() + offset, sizeof number);
    return number;
}

std::string_view view(const std::vector<std::byte>& bytes) {
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

std::string text_of(const RunIdentity& identity) {
    const RowShape& shape = identity.shape;
    return fmt::format("{}\n{}\n{} {} {} {} {} {}{}{}\n{}", identity.version, identity.seed,
                       shape.parameters, shape.features, shape.levels, shape.meshes, shape.variants,
                       shape.integration, identity.part.empty() ? "" : " ", identity.part,
                       identity.study);
}

RunIdentity identity_of(const std::string& text) {
    RunIdentity identity;
    const std::size_t version = text.find('\n');
    const std::size_t seed = text.find('\n', version + 1);
    const std::size_t shape = text.find('\n', seed + 1);
    identity.version = text.substr(0, version);
    identity.seed = text.substr(version + 1, seed - version - 1);
    std::istringstream numbers(text.substr(seed + 1, shape - seed - 1));
    RowShape& own = identity.shape;
    numbers >> own.parameters >> own.features >> own.levels >> own.meshes >> own.variants >>
        own.integration >> identity.part;
    identity.study = text.substr(shape + 1);
    return identity;
}

std::string header_of(const RunIdentity& identity) {
    const std::string text = text_of(identity);
    std::string header(kMagic);
    header += number_bytes(text.size()) + text;
    return header + number_bytes(fnv1a(header));
}

std::uint64_t record_sum(std::size_t batch, std::string_view record) {
    return fnv1a(record.substr(0, record.size() - 8), fnv1a(number_bytes(batch)));
}

bool all_zero(std::string_view bytes) {
    return bytes.find_first_not_of('\0') == std::string_view::npos;
}

// Description of the process that holds the lock on a file.
std::string worker_of(int fd) {
    std::vector<std::byte> head(kMagic.size() + 8), worker(kWorkerBytes);
    if (read_at(fd, head, 0) < static_cast<ssize_t>(head.size())) {
        return "another run";
    }
    const std::uint64_t length =
        std::min<std::uint64_t>(number_at(view(head), kMagic.size()), kMostText);
    const auto at = static_cast<off_t>(head.size() + length + 8 + kCounterBytes);
    const ssize_t got = read_at(fd, worker, at);
    const std::string_view text =
        view(worker).substr(0, got > 0 ? static_cast<std::size_t>(got) : 0);
    const std::string who(text.substr(0, text.find('\0')));
    return who.empty() ? "another run" : "another run (" + who + ")";
}

struct flock whole_file() {
    struct flock lock {};
    lock.l_type = F_WRLCK;
    lock.l_whence = SEEK_SET;
    return lock;
}

// Takes the lock. It ends with the process that holds it. Returns "", or a description of the
// process that has it. Files that cannot be locked (on some network file systems) count as free.
std::string lock(int fd) {
    struct flock own = whole_file();
    const bool taken = ::fcntl(fd, F_SETLK, &own) != 0 && (errno == EACCES || errno == EAGAIN);
    return taken ? worker_of(fd) : "";
}

std::string busy_text(const std::string& worker) {
    return worker + " is using it; wait until it ends, or name another file with --out";
}

// Description of the process that uses an existing checkpoint; "" if there is none or it cannot be
// determined.
std::string worker_on(const std::string& path) {
    const Descriptor file(::open(path.c_str(), kOpenExisting | O_RDONLY));
    struct flock lock_query = whole_file();
    const bool taken = file.get() >= 0 && ::fcntl(file.get(), F_GETLK, &lock_query) == 0 &&
                       lock_query.l_type != F_UNLCK;
    return taken ? worker_of(file.get()) : "";
}

std::string worker_text() {
    std::array<char, 65> host{};
    ::gethostname(host.data(), host.size() - 1);
    const std::time_t now = std::time(nullptr);
    std::array<char, 32> since{};
    std::tm local{};
    std::strftime(since.data(), since.size(), "%Y-%m-%d %H:%M:%S", ::localtime_r(&now, &local));
    return fmt::format("process {} on {} since {}", ::getpid(), host.data(), since.data());
}

}  // namespace

Checkpoint::Checkpoint(std::string path, Descriptor file, const RunIdentity& identity,
                       const BatchPlan& plan)
    : path_(std::move(path)),
      file_(std::move(file)),
      identity_(identity),
      plan_(plan),
      header_(header_of(identity)),
      done_(plan.batches()) {
    if (file_.get() < 0) {
        fail(fmt::format("cannot be opened ({})", std::strerror(errno)));
    }
    const std::size_t end = header_.size() + kCounterBytes + kWorkerBytes;
    begin_ = static_cast<off_t>((end + kBlock - 1) / kBlock * kBlock);
}

void Checkpoint::fail(const std::string& what) const {
    throw std::runtime_error(path_ + ": " + what);
}

std::size_t Checkpoint::most_rows(std::size_t batch) const {
    return kBatchRows * (batch < plan_.threshold_batches() ? plan_.threshold_records() : 1);
}

std::size_t Checkpoint::record_bytes(std::size_t batch) const {
    return 8 * (kStatusAt + most_rows(batch) * (1 + identity_.shape.values()) + 1);
}

off_t Checkpoint::place(std::size_t batch) const {
    const std::size_t thresholds = std::min(batch, plan_.threshold_batches());
    const std::size_t before =
        (thresholds > 0 ? thresholds * record_bytes(0) : 0) +
        (batch > thresholds ? (batch - thresholds) * record_bytes(batch) : 0);
    return begin_ + static_cast<off_t>(before);
}

bool Checkpoint::exists(const std::string& path) {
    struct stat status {};
    return ::lstat(path.c_str(), &status) == 0;
}

// Stores a description of this process in the file.
void Checkpoint::write_worker() {
    std::string text = worker_text().substr(0, kWorkerBytes - 1);
    text.resize(kWorkerBytes, '\0');
    const auto at = static_cast<off_t>(header_.size() + kCounterBytes);
    if (!write_at(file_.get(), std::as_bytes(std::span(text)), at)) {
        fail(fmt::format("cannot be written ({})", std::strerror(errno)));
    }
}

std::unique_ptr<Checkpoint> Checkpoint::create(const std::string& path, const RunIdentity& identity,
                                               const BatchPlan& plan) {
    const std::string header = header_of(identity);
    // The file is locked before it has its name: a second run sees no checkpoint, or one in use.
    const int fd = create_exclusively(path, std::as_bytes(std::span(header)),
                                      [](int file) { static_cast<void>(lock(file)); });
    if (fd < 0 && errno == EEXIST) {
        const std::string worker = worker_on(path);
        throw std::runtime_error(path + ": " +
                                 (worker.empty()
                                      ? "contains the finished batches of an interrupted run or "
                                        "merge; continue a run with "
                                        "`run --resume`, or delete this file to start again"
                                      : busy_text(worker)));
    }
    std::unique_ptr<Checkpoint> checkpoint(new Checkpoint(path, Descriptor(fd), identity, plan));
    checkpoint->write_worker();
    checkpoint->sync();
    return checkpoint;
}

std::unique_ptr<Checkpoint> Checkpoint::resume(const std::string& path, const RunIdentity& identity,
                                               const BatchPlan& plan) {
    std::unique_ptr<Checkpoint> checkpoint(new Checkpoint(
        path, Descriptor(::open(path.c_str(), kOpenExisting | O_RDWR)), identity, plan));
    struct stat status {};
    if (::fstat(checkpoint->file_.get(), &status) != 0 || !S_ISREG(status.st_mode)) {
        checkpoint->fail(
            "is not a regular file and cannot be a checkpoint; remove it, or name another file "
            "with --out");
    }
    if (const std::string worker = lock(checkpoint->file_.get()); !worker.empty()) {
        checkpoint->fail(busy_text(worker));
    }
    checkpoint->check_header();
    checkpoint->write_worker();
    checkpoint->scan();
    checkpoint->sync();
    return checkpoint;
}

void Checkpoint::check_header() {
    constexpr const char* kDamaged = "is damaged (its header); delete it to start again";
    std::vector<std::byte> head(kMagic.size() + 8);
    const ssize_t got = read_at(file_.get(), head, 0);
    if (got < static_cast<ssize_t>(head.size()) || !view(head).starts_with(kMagic)) {
        fail("is not a checkpoint of this program, or is damaged; delete it to start again");
    }
    const std::uint64_t length = number_at(view(head), kMagic.size());
    if (length > kMostText) {
        fail(kDamaged);
    }
    std::vector<std::byte> whole(head.size() + length + 8);
    const bool read = read_at(file_.get(), whole, 0) == static_cast<ssize_t>(whole.size());
    const std::string_view text = view(whole);
    if (!read || number_at(text, text.size() - 8) != fnv1a(text.substr(0, text.size() - 8))) {
        fail(kDamaged);
    }
    const std::string why =
        difference(identity_of(std::string(text.substr(head.size(), length))), identity_);
    if (!why.empty()) {
        fail(why + "; delete it to start again");
    }
}

// Number of batches at the last sync; 0 if the counter was never written.
std::uint64_t Checkpoint::synced_before() {
    std::vector<std::byte> counter(24);
    const auto at = static_cast<off_t>(header_.size());
    if (read_at(file_.get(), counter, at) < 24) {
        return 0;
    }
    const std::string_view bytes = view(counter);
    if (number_at(bytes, 16) != fnv1a(bytes.substr(0, 16))) {
        if (!all_zero(bytes)) {
            findings_.push_back(path_ + ": its counter of finished batches is damaged");
        }
        return 0;
    }
    if (number_at(bytes, 0) > plan_.test_gearboxes()) {
        fail(
            fmt::format("belongs to a run with {} test gearboxes, more than the {} requested; "
                        "raise --instances, or delete it to start again",
                        number_at(bytes, 0), plan_.test_gearboxes()));
    }
    return number_at(bytes, 8);
}

// Reads all batches once and marks those that are complete.
void Checkpoint::scan() {
    const std::uint64_t synced = synced_before();
    std::size_t damaged = 0, partial = 0;
    for (std::size_t batch = 0; batch < plan_.batches(); ++batch) {
        scratch_.assign(record_bytes(batch), std::byte{});
        if (read_at(file_.get(), scratch_, place(batch)) < 0) {
            fail(fmt::format("cannot be read ({})", std::strerror(errno)));
        }
        const std::string_view record = view(scratch_);
        if (all_zero(record)) {
            continue;
        }
        const bool whole = number_at(record, 0) == kBatchMark &&
                           number_at(record, record.size() - 8) == record_sum(batch, record);
        const std::uint64_t rows = number_at(record, 8);
        if (!whole || rows > plan_.batch(batch).rows()) {
            ++damaged;
        } else if (rows < plan_.batch(batch).rows()) {
            ++partial;  // last batch of a smaller ensemble; it is computed again as a whole
        } else {
            done_[batch] = true;
            ++count_;
        }
    }
    if (damaged > 0) {
        findings_.push_back(
            fmt::format("{}: {} batch{} damaged or incomplete (wrong checksum); computed again",
                        path_, damaged, damaged == 1 ? " is" : "es are"));
    }
    if (count_ + damaged + partial < synced) {
        findings_.push_back(
            fmt::format("{}: {} of {} batches that it had at its last checkpoint are missing (was "
                        "it truncated?); computed again",
                        path_, synced - count_ - damaged - partial, synced));
    }
}

BatchRows Checkpoint::read(std::size_t batch) const {
    std::vector<std::byte> buffer(record_bytes(batch));
    const ssize_t got = read_at(file_.get(), buffer, place(batch));
    const std::string_view record = view(buffer);
    if (got < static_cast<ssize_t>(buffer.size()) ||
        number_at(record, record.size() - 8) != record_sum(batch, record)) {
        fail(fmt::format("batch {} is damaged or incomplete", batch));
    }
    BatchRows rows;
    const std::size_t count = plan_.batch(batch).rows();
    for (std::size_t i = 0; i < count; ++i) {
        rows.status.push_back(static_cast<int>(number_at(record, 8 * (kStatusAt + i))));
    }
    rows.values.resize(count * identity_.shape.values());
    std::memcpy(rows.values.data(), buffer.data() + 8 * (kStatusAt + most_rows(batch)),
                8 * rows.values.size());
    return rows;
}

void Checkpoint::write(std::size_t batch, const BatchRows& rows) {
    scratch_.assign(record_bytes(batch), std::byte{});
    const auto put = [&](std::size_t place, std::uint64_t number) {
        std::memcpy(scratch_.data() + 8 * place, &number, 8);
    };
    put(0, kBatchMark);
    put(1, rows.count());
    for (std::size_t i = 0; i < rows.count(); ++i) {
        put(kStatusAt + i, static_cast<std::uint64_t>(rows.status[i]));
    }
    std::memcpy(scratch_.data() + 8 * (kStatusAt + most_rows(batch)), rows.values.data(),
                8 * rows.values.size());
    put(scratch_.size() / 8 - 1, record_sum(batch, view(scratch_)));
    if (!write_at(file_.get(), scratch_, place(batch))) {
        fail(fmt::format("cannot be written ({})", std::strerror(errno)));
    }
    if (!done_[batch]) {
        done_[batch] = true;
        ++count_;
    }
}

void Checkpoint::write_counter() {
    std::string counter = number_bytes(plan_.test_gearboxes()) + number_bytes(count_);
    counter += number_bytes(fnv1a(counter));
    if (!write_at(file_.get(), std::as_bytes(std::span(counter)),
                  static_cast<off_t>(header_.size())) ||
        ::fsync(file_.get()) != 0) {
        fail(fmt::format("cannot be written ({})", std::strerror(errno)));
    }
}

long Checkpoint::rows_done() const {
    std::size_t rows = 0;
    for (std::size_t batch = 0; batch < plan_.batches(); ++batch) {
        rows += has(batch) ? plan_.batch(batch).rows() : 0;
    }
    return static_cast<long>(rows);
}

// Syncs the batches before the counter, so that the counter never includes missing batches.
void Checkpoint::sync() {
    if (::fsync(file_.get()) != 0) {
        fail(fmt::format("cannot be written ({})", std::strerror(errno)));
    }
    write_counter();
}

void Checkpoint::remove() {
    ::unlink(path_.c_str());
}

}  // namespace gearpod::mc
