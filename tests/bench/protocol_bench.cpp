// Measures how fast packets are found in a stream, compared with a loop that sums the same bytes.

#include "protocol/decoder.h"

#include <benchmark/benchmark.h>

namespace {

using namespace orb;

constexpr std::size_t payload = 64;
constexpr std::size_t packets = 4096;

Bytes stream() {
  Bytes out;
  for (std::size_t i = 0; i < packets; ++i) {
    Bytes data(payload);
    for (std::size_t j = 0; j < payload; ++j)
      data[j] = static_cast<std::uint8_t>(i * 31 + j * 7);
    encode(protocol::make_command(spec::ApiCommand::SaveTemporaryMacro, std::move(data),
                                  static_cast<std::uint8_t>(i)),
           out);
  }
  return out;
}

void finish(benchmark::State& state, const Bytes& bytes) {
  state.SetBytesProcessed(static_cast<std::int64_t>(state.iterations() * bytes.size()));
}

/// The baseline: the least that any checksum has to do.
void SumBytes(benchmark::State& state) {
  const auto bytes = stream();
  for (auto _ : state) {
    std::uint32_t sum = 0;
    for (const auto byte : bytes)
      sum += byte;
    benchmark::DoNotOptimize(sum);
  }
  finish(state, bytes);
}
BENCHMARK(SumBytes);

void DecodePackets(benchmark::State& state) {
  const auto bytes = stream();
  for (auto _ : state) {
    protocol::Decoder decoder(protocol::Direction::ToBall);
    decoder.feed(bytes);
    std::size_t found = 0;
    while (const auto item = decoder.next())
      found += item->kind == protocol::Item::Kind::Command;
    if (found != packets)
      state.SkipWithError("not every packet was found");
  }
  finish(state, bytes);
}
BENCHMARK(DecodePackets);

/// In pieces that end anywhere, as a serial link delivers them.
void DecodePieces(benchmark::State& state) {
  const auto bytes = stream();
  constexpr std::size_t piece = 1000;
  for (auto _ : state) {
    protocol::Decoder decoder(protocol::Direction::ToBall);
    std::size_t found = 0;
    for (std::size_t at = 0; at < bytes.size(); at += piece) {
      decoder.feed(ByteView(bytes).subspan(at, std::min(piece, bytes.size() - at)));
      while (const auto item = decoder.next())
        found += item->kind == protocol::Item::Kind::Command;
    }
    if (found != packets)
      state.SkipWithError("not every packet was found");
  }
  finish(state, bytes);
}
BENCHMARK(DecodePieces);

} // namespace
