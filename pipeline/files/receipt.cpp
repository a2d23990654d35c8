#include "pipeline/files/receipt.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>

#include <cstdio>
#include <fstream>

#include "pipeline/errors.h"
#include "pipeline/files/checksum.h"
#include "pipeline/files/digest.h"

namespace dresslife::pipeline {

const std::string& Digests::of(const std::filesystem::path& file) {
  const auto [entry, fresh] = known_.try_emplace(file);
  if (fresh) {
    try {
      entry->second = xxh3_of_file(file);
    } catch (const InputError&) {
      entry->second = "absent";
    }
  }
  return entry->second;
}

std::string recipe_of(std::string_view settings, const std::vector<std::filesystem::path>& files,
                      const std::filesystem::path& program, Digests& digests) {
  Xxh3 digest;
  // Lengths before texts: no two lists run into the same bytes.
  const auto add = [&](std::string_view text) {
    const std::string length = fmt::format("{}:", text.size());
    digest.add(length.data(), length.size());
    digest.add(text.data(), text.size());
  };
  add(settings);
  for (const std::filesystem::path& file : files) {
    add(file.string());
    add(digests.of(file));
  }
  add(digests.of(program));
  return digest.hex();
}

std::optional<Receipt> read_receipt(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  Receipt receipt;
  FileState& state = receipt.state;
  std::string word[4], end;
  if (!(in >> word[0] >> receipt.recipe >> word[1] >> receipt.input >> word[2] >> receipt.output >> word[3] >>
        state.size >> state.modified_ns >> state.changed_ns >> state.inode >> end) ||
      word[0] != "recipe" || word[1] != "input" || word[2] != "output" || word[3] != "state" || end != "end")
    return std::nullopt;
  receipt.written_ns = state_of(file).changed_ns;
  return receipt;
}

namespace {

std::string text_of(const Receipt& receipt) {
  const FileState& state = receipt.state;
  return fmt::format("recipe {}\ninput {}\noutput {}\nstate {} {} {} {}\nend\n", receipt.recipe,
                     receipt.input, receipt.output, state.size, state.modified_ns, state.changed_ns,
                     state.inode);
}

}  // namespace

void write_receipt(const std::filesystem::path& file, Receipt receipt, const std::filesystem::path& output) {
  receipt.state = state_of(output);
  write_text_if_changed(file, text_of(receipt), Sync::never);
  // A receipt that says what it said before is now as young as this look at the output.
  if (state_of(file).changed_ns <= receipt.state.changed_ns) ::utimensat(AT_FDCWD, file.c_str(), nullptr, 0);
}

void renew_receipt(const std::filesystem::path& file, const std::filesystem::path& output) {
  const std::optional<Receipt> receipt = read_receipt(file);
  const FileState state = state_of(output);
  // The bytes are compared after the state was taken: what changes them later changes the state.
  if (receipt && checksum_of(output) == receipt->output && state_of(output) == state)
    write_receipt(file, *receipt, output);
}

bool is_as_noted(const Receipt& receipt, const std::filesystem::path& output) {
  const FileState now = state_of(output);
  if (!now.exists()) return false;
  return (receipt.state_suffices() && receipt.state == now) || checksum_of(output) == receipt.output;
}

}  // namespace dresslife::pipeline
