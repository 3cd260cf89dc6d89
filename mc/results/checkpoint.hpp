// Checkpoint of a run: a file in the folder of the results with all finished batches. A run that is
// killed can be resumed from it.
//
//   header      "gearpod tiles 2\n", length of the text (u64), text with the run's identity,
//               FNV-1a of all that
//   counter     test gearboxes requested (u64), batches safe at the last sync (u64), FNV-1a of
//               both
//   worker      256 bytes: process that uses the file, and since when, as text; valid while locked
//   batch b     from the next multiple of 4096 on; one size per group: mark, rows (u64), status
//               of each row (i64), RowShape::values() doubles per row, FNV-1a of b and of all that
//
// Numbers are little-endian. A batch that was never written is a hole (zeros). Every batch has its
// own checksum. A batch that is incomplete, damaged or misplaced counts as not computed and is
// reported.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "mc/files/atomic_file.hpp"
#include "mc/results/provenance.hpp"
#include "mc/results/result_rows.hpp"

namespace gearpod::mc {

class Checkpoint final : public RowStore {
  public:
    // Creates an empty checkpoint. Throws std::runtime_error naming the path and the reason. An
    // existing checkpoint is an error, so that its batches are not lost; the message tells whether
    // a run uses it.
    static std::unique_ptr<Checkpoint> create(const std::string& path, const RunIdentity& identity,
                                              const BatchPlan& plan);
    // Opens an existing checkpoint. Throws std::runtime_error naming the path and the reason:
    // damaged header, other study, seed or version, more gearboxes than in the plan, in use by
    // another run.
    static std::unique_ptr<Checkpoint> resume(const std::string& path, const RunIdentity& identity,
                                              const BatchPlan& plan);
    static bool exists(const std::string& path);

    bool has(std::size_t batch) const override { return done_[batch]; }
    BatchRows read(std::size_t batch) const override;
    // Throws std::runtime_error naming the path and the reason (disk full).
    void write(std::size_t batch, const BatchRows& rows) override;
    void sync() override;
    // Deletes the file after the results have been written.
    void remove();

    std::size_t batches_done() const { return count_; }
    long rows_done() const;
    const std::string& path() const { return path_; }
    // Problems that resume() found, one per line; the batches concerned are computed again.
    const std::vector<std::string>& findings() const { return findings_; }

  private:
    Checkpoint(std::string path, Descriptor file, const RunIdentity& identity,
               const BatchPlan& plan);

    [[noreturn]] void fail(const std::string& what) const;
    void write_worker();
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
    std::vector<bool> done_;  // indexed by batch
    std::size_t count_ = 0;
    std::vector<std::string> findings_;
    std::vector<std::byte> scratch_;
};

}  // namespace gearpod::mc
