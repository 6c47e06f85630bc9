#pragma once

#include "bytecode/chunk.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <string>
#include <string_view>
#include <tl/expected.hpp>
#include <vector>

namespace orb::vm {

struct Core;

/// When a program is compiled to machine code: after it has run long enough, before it starts, or
/// never.
enum class Native : std::uint8_t { Auto, On, Off };

/// Returns true if this build can generate code for its processor.
bool has_native_code();

/// A program as machine code. It implements arithmetic, Z, tests, loops, jumps and subroutines;
/// every other line, and every rare case such as an error, is left to the loop of machine/loop.h.
/// Execution can switch between the two at any line.
class NativeCode {
public:
  /// Machine code of one line, for profilers; line 0 is the entry or exit code.
  struct Piece {
    int line = 0;
    const void* address = nullptr;
    std::size_t size = 0;
  };

  /// Compiles a chunk that passes bytecode::verify(). Otherwise returns the reason in words: no
  /// back end, no executable memory, a program too large for any ball.
  static tl::expected<std::unique_ptr<NativeCode>, std::string_view>
  compile(const bytecode::Chunk& chunk);
  NativeCode(const NativeCode&) = delete;
  NativeCode& operator=(const NativeCode&) = delete;
  ~NativeCode();

  /// Executes lines from core.pc until it meets a line it cannot run, or the budget may not suffice
  /// for the next block; core.pc is then the next line. All other state in `core` is as the loop
  /// would leave it.
  void run(Core& core) const;

  const std::vector<Piece>& pieces() const { return pieces_; }

  /// Most lines per block, which share one check of the budget. With a smaller budget the loop
  /// takes over.
  static constexpr int longest_block = 16;

private:
  NativeCode() = default;

  void* memory_ = nullptr;
  std::size_t size_ = 0;
  const void* const* table_ = nullptr; ///< entry address of each line, by its first instruction
  std::vector<Piece> pieces_;
};

/// Machine code cache, so that balls with the same program share it. Thread-safe. The code lives as
/// long as this object.
class NativePrograms {
public:
  /// Returns the machine code; null if the program can only be interpreted or the cache is full.
  const NativeCode* find(const bytecode::Chunk& chunk);

private:
  struct Kept {
    bytecode::Chunk chunk;
    std::unique_ptr<NativeCode> code;
  };
  std::mutex mutex_;
  std::vector<Kept> kept_;
};

/// A disassembly of machine code.
struct NativeListing {
  std::string entry;              ///< entry code
  std::vector<std::string> lines; ///< in the order of the chunk's lines
  std::string exits;              ///< exit code, of each line and common
};

/// Returns an empty listing if this build has no back end.
NativeListing native_listing(const bytecode::Chunk& chunk);

} // namespace orb::vm
