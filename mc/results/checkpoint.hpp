// The checkpoint of a run: a file beside the results that holds every finished tile at its place,
// so that a run killed at any moment continues where it was.
//
//   header      "gearpod tiles 1\n", length of the text (u64), text that says what the run is,
//               FNV-1a of all that
//   counter     graded gearboxes asked for (u64), tiles safe at the last sync (u64), FNV-1a of both
//   tile t      at kTilesBegin-aligned begin + t * record size: mark, rows (u64), 8 status (i64),
//               8 x RowShape::values() doubles, FNV-1a of t and of all that
//
// Little-endian. A tile that was never written is a hole (zeros). Every tile carries its checksum:
// one that is torn, damaged or at another place counts as not computed and is reported.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "mc/files/file_descriptor.hpp"
#include "mc/results/run_identity.hpp"
#include "mc/results/tile_rows.hpp"

namespace gearpod::mc {

class Checkpoint final : public RowStore {
  public:
    // A new, empty one. Throws std::runtime_error naming the path and the reason, also where one
    // exists: what an interrupted run computed is not thrown away.
    static std::unique_ptr<Checkpoint> create(const std::string& path, const RunIdentity& identity,
                                              const TilePlan& plan);
    // Continues one. Throws std::runtime_error naming the path and the reason: damaged header,
    // another study, seed or version, more gearboxes than the plan has, in use by another run.
    static std::unique_ptr<Checkpoint> resume(const std::string& path, const RunIdentity& identity,
                                              const TilePlan& plan);
    static bool exists(const std::string& path);

    bool has(std::size_t tile) const override { return done_[tile]; }
    TileRows read(std::size_t tile) const override;
    // Throws std::runtime_error naming the path and the reason (disk full).
    void write(std::size_t tile, const TileRows& rows) override;
    void sync() override;
    // Deletes the file: the results are safe elsewhere.
    void remove();

    std::size_t tiles_done() const { return count_; }
    const std::string& path() const { return path_; }
    // What resume() found amiss, one line each; those tiles are computed again.
    const std::vector<std::string>& findings() const { return findings_; }

  private:
    Checkpoint(std::string path, Descriptor file, const RunIdentity& identity,
               const TilePlan& plan);

    [[noreturn]] void fail(const std::string& what) const;
    void lock();
    void check_header();
    void scan();
    std::uint64_t synced_before();
    void write_counter();
    off_t place(std::size_t tile) const;
    std::size_t record_bytes() const;

    std::string path_;
    Descriptor file_;
    RunIdentity identity_;
    TilePlan plan_;
    std::string header_;
    off_t begin_ = 0;
    std::vector<bool> done_;  // by tile
    std::size_t count_ = 0;
    std::vector<std::string> findings_;
    std::vector<std::byte> scratch_;
};

}  // namespace gearpod::mc
