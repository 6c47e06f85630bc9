#include "vm/machine/native/native.h"

#include "vm/machine/core.h"

#include <utility>

#if defined(ORB_NATIVE)
#include "vm/machine/native/writer.h"
#endif

namespace orb::vm {

namespace {

using bytecode::Chunk;

constexpr std::size_t most_kept = 64;

} // namespace

const NativeCode* NativePrograms::find(const Chunk& chunk) {
  const std::lock_guard lock(mutex_);
  for (const auto& kept : kept_)
    if (kept.chunk == chunk)
      return kept.code.get();
  if (kept_.size() == most_kept)
    return nullptr;
  auto made = NativeCode::compile(chunk);
  kept_.push_back({chunk, made ? *std::move(made) : nullptr});
  return kept_.back().code.get();
}

#if defined(ORB_NATIVE)

namespace {

/// Called with the Unix convention, even on Windows.
using Entry [[gnu::sysv_abi]] = std::uint32_t (*)(std::int32_t* registers, Frames* frames,
                                                  std::int64_t* budget, const void* line);

constexpr std::size_t most_instructions = 4096; // more than any area of the robot has characters
constexpr std::string_view too_large = "the program is too large for machine code";

/// The generated code of a program, before it is copied to executable memory.
struct Draft final : asmjit::ErrorHandler {
  explicit Draft(const Chunk& chunk, asmjit::StringLogger* log = nullptr) {
    code.init(asmjit::Environment::host());
    code.setErrorHandler(this);
    code.setLogger(log);
    native::x86::Assembler assembler(&code);
    const native::Plan plan(chunk);
    native::Writer writer(chunk, plan, assembler);
    places = writer.program(log);
    code.flatten();
    code.resolveUnresolvedLinks();
    failed = failed || code.hasUnresolvedLinks();
    table = code.labelOffset(writer.table());
  }

  void handleError(asmjit::Error, const char*, asmjit::BaseEmitter*) override { failed = true; }

  bool failed = false; ///< set by the first error, so that the writer need not check each call
  asmjit::CodeHolder code;
  std::vector<native::Writer::CodePlace> places;
  std::size_t table = 0;
};

} // namespace

bool has_native_code() {
  return true;
}

tl::expected<std::unique_ptr<NativeCode>, std::string_view>
NativeCode::compile(const Chunk& chunk) {
  namespace memory = asmjit::VirtMem;
  constexpr std::string_view denied = "this system does not allow executable memory";
  if (chunk.code.size() > most_instructions)
    return tl::unexpected(too_large);
  Draft draft(chunk);
  if (draft.failed)
    return tl::unexpected(too_large);
  std::unique_ptr<NativeCode> made(new NativeCode);
  made->size_ = draft.code.codeSize();
  if (memory::alloc(&made->memory_, made->size_, memory::MemoryFlags::kAccessRW) != 0)
    return tl::unexpected(denied);
  draft.code.relocateToBase(reinterpret_cast<std::uintptr_t>(made->memory_));
  draft.code.copyFlattenedData(made->memory_, made->size_);
  if (draft.failed)
    return tl::unexpected(too_large);
  if (memory::protect(made->memory_, made->size_, memory::MemoryFlags::kAccessRX) != 0)
    return tl::unexpected(denied);
  char* const base = static_cast<char*>(made->memory_);
  made->table_ = reinterpret_cast<const void* const*>(base + draft.table);
  for (std::size_t i = 0; i + 1 < draft.places.size(); ++i) {
    const bool is_line = i > 0 && i <= chunk.lines.size();
    made->pieces_.push_back({is_line ? chunk.lines[i - 1].number : 0, base + draft.places[i].code,
                             draft.places[i + 1].code - draft.places[i].code});
  }
  return made;
}

NativeCode::~NativeCode() {
  if (memory_)
    asmjit::VirtMem::release(memory_, size_);
}

void NativeCode::run(Core& core) const {
  const auto enter = reinterpret_cast<Entry>(memory_);
  const void* const line = table_[core.index_of(core.pc)];
  core.pc = core.code.data() + enter(core.registers.data(), &core.frames, &core.budget, line);
}

NativeListing native_listing(const Chunk& chunk) {
  asmjit::StringLogger log;
  log.setIndentation(asmjit::FormatIndentationGroup::kCode, 10);
  log.setIndentation(asmjit::FormatIndentationGroup::kLabel, 8);
  const Draft draft(chunk, &log);
  std::vector<std::string> pieces;
  for (std::size_t i = 0; i + 1 < draft.places.size(); ++i)
    pieces.emplace_back(log.data() + draft.places[i].log,
                        draft.places[i + 1].log - draft.places[i].log);
  return {pieces.front(), {pieces.begin() + 1, pieces.end() - 1}, pieces.back()};
}

#else

bool has_native_code() {
  return false;
}
tl::expected<std::unique_ptr<NativeCode>, std::string_view> NativeCode::compile(const Chunk&) {
  return tl::unexpected(std::string_view("this build cannot generate machine code"));
}
NativeCode::~NativeCode() = default;
void NativeCode::run(Core&) const {}
NativeListing native_listing(const Chunk&) {
  return {};
}

#endif
} // namespace orb::vm
