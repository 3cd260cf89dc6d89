// The checkpoint of a run: a file beside the results that holds every finished batch at its place,
// so that a run killed at any moment continues where it was.
//
//   header      "gearpod tiles 2\n", length of the text (u64), text that says what the run is,
//               FNV-1a of all that
//   counter     graded gearboxes asked for (u64), batches safe at the last sync (u64), FNV-1a of
//               both
//   worker      256 bytes: who works on it, and since when, as text; counts while a lock is held
//   batch b     from the next multiple of 4096 on, all of one size: mark, rows (u64), 16 status
//               (i64), 16 x RowShape::values() doubles, FNV-1a of b and of all that
//
// Little-endian. A batch that was never written is a hole (zeros). Every batch carries its
// checksum: one that is torn, damaged or at another place counts as not computed and is reported.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "mc/files/file_descriptor.hpp"
#include "mc/results/batch_rows.hpp"
#include "mc/results/run_identity.hpp"

namespace gearpod::mc {

class Checkpoint final : public RowStore {
  public:
    // A new, empty one. Throws std::runtime_error naming the path and the reason, also where one
    // exists, and then whether a run works on it: what an interrupted run computed is not thrown
    // away.
    static std::unique_ptr<Checkpoint> create(const std::string& path, const RunIdentity& identity,
                                              const BatchPlan& plan);
    // Continues one. Throws std::runtime_error naming the path and the reason: damaged header,
    // another study, seed or version, more gearboxes than the plan has, in use by another run.
    static std::unique_ptr<Checkpoint> resume(const std::string& path, const RunIdentity& identity,
                                              const BatchPlan& plan);
    static bool exists(const std::string& path);

    bool has(std::size_t batch) const override { return done_[batch]; }
    BatchRows read(std::size_t batch) const override;
    // Throws std::runtime_error naming the path and the reason (disk full).
    void write(std::size_t batch, const BatchRows& rows) override;
    void sync() override;
    // Deletes the file: the results are safe elsewhere.
    void remove();

    std::size_t batches_done() const { return count_; }
    long rows_done() const;
    const std::string& path() const { return path_; }
    // What resume() found amiss, one line each; those batches are computed again.
    const std::vector<std::string>& findings() const { return findings_; }

  private:
    Checkpoint(std::string path, Descriptor file, const RunIdentity& identity,
               const BatchPlan& plan);

    [[noreturn]] void fail(const std::string& what) const;
    void sign();
    void check_header();
    void scan();
    std::uint64_t synced_before();
    void write_counter();
    off_t place(std::size_t batch) const;
    std::size_t most_rows(std::size_t batch) const;
    std::size_t record_bytes(std::size_t batch) const;

    std::string path_;
    Descriptor file_;
    RunIdentity identity_;
    BatchPlan plan_;
    std::string header_;
    off_t begin_ = 0;
    std::vector<bool> done_;  // by batch
    std::size_t count_ = 0;
    std::vector<std::string> findings_;
    std::vector<std::byte> scratch_;
};

}  // namespace gearpod::mc
