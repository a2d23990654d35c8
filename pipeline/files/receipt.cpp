#include "pipeline/files/receipt.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>

#include <algorithm>
#include <chrono>

#include "pipeline/base/digest.h"
#include "pipeline/base/errors.h"
#include "pipeline/files/checksum.h"
#include "pipeline/files/files.h"
#include "pipeline/files/words.h"

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
  // Each text follows its length, so that different lists never give the same bytes.
  const auto add = [&](std::string_view text) {
    const std::string length = fmt::format("{}:", text.size());
    digest.add(length.data(), length.size());
    digest.add(text.data(), text.size());
  };
  add(settings);
  for (const std::filesystem::path& file : files) {
    add(file.filename().string());
    add(digests.of(file));
  }
  add(digests.of(program));
  return digest.hex();
}

std::vector<ResultValue> results_in(const std::filesystem::path& file, const Format& format) {
  const FileReader reader(file, format, FileReader::Scope::attributes);
  std::vector<ResultValue> all;
  for (const AttributeInfo& attribute : format.attributes) {
    if (!reader.has_attribute(attribute.name)) continue;
    ResultValue& results = all.emplace_back();
    results.name = attribute.name;
    if (attribute.is_text)
      results.text = reader.text_attribute(attribute.name);
    else
      results.number = reader.number_attribute(attribute.name);
  }
  return all;
}

namespace {

/// Returns the text of a short file and the time of its last change.
std::optional<std::string> whole_text(const std::filesystem::path& name, std::int64_t& changed_ns) {
  constexpr std::uint64_t longest = 1 << 20;
  if (!state_of(name).exists()) return std::nullopt;
  const PlainFile file(name);
  changed_ns = file.state().changed_ns;
  return file.size() <= longest ? std::optional(file.text()) : std::nullopt;
}

/// in_line() replaces line feeds of a text, out_of_line() restores them.
std::string in_line(const std::string& text) {
  std::string line;
  for (const char letter : text) line += letter == '\n' ? "\\n" : letter == '\\' ? "\\\\" : std::string(1, letter);
  return line;
}
std::string out_of_line(std::string_view line) {
  std::string text;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const bool escaped = line[i] == '\\' && i + 1 < line.size();
    text += !escaped ? line[i] : line[i + 1] == 'n' ? '\n' : line[i + 1];
    i += escaped;
  }
  return text;
}

std::string words_of(const FileState& state) {
  return fmt::format("{} {} {} {}", state.size, state.modified_ns, state.changed_ns, state.inode);
}

/// end: the character behind the state.
FileState state_in(Words& words, char end) {
  FileState state;
  state.size = words.number<std::int64_t>(' ');
  state.modified_ns = words.number<std::int64_t>(' ');
  state.changed_ns = words.number<std::int64_t>(' ');
  state.inode = words.number<std::uint64_t>(end);
  return state;
}

/// Returns the text of a receipt without the digest at its end.
std::string text_of(const Receipt& receipt) {
  std::string text = fmt::format("recipe {}\ninput {}\noutput {}\nstate {}\n", receipt.recipe, receipt.input,
                                 receipt.output, words_of(receipt.state));
  for (const ResultValue& results : receipt.results)
    text += results.text.empty() ? fmt::format("number {} {}\n", results.name, results.number)
                                 : fmt::format("text {} {}\n", results.name, in_line(results.text));
  for (const auto& [what, digest] : receipt.made_with) text += fmt::format("with {} {}\n", digest, in_line(what));
  return text;
}

}  // namespace

std::string note_digests(const std::vector<std::filesystem::path>& files) {
  constexpr auto tick = std::chrono::milliseconds(10);  // of the file times of the slowest kernels
  std::string notes;
  for (const std::filesystem::path& file : files) {
    const FileState state = state_of(file);
    const auto now = std::chrono::system_clock::now().time_since_epoch();
    if (!state.exists() || now - std::chrono::nanoseconds(state.changed_ns) < tick) continue;
    const std::string digest = Digests().of(file);
    if (state_of(file) == state) notes += fmt::format("{} {} {}\n", digest, words_of(state), in_line(file.string()));
  }
  return notes;
}

void Digests::believe(std::string_view notes) {
  for (Words lines(notes); lines.any();) {
    const std::string digest(lines.until(' '));
    const FileState then = state_in(lines, ' ');
    const std::filesystem::path file = out_of_line(lines.until('\n'));
    if (then.exists() && state_of(file) == then) known_.try_emplace(file, digest);
  }
}

std::optional<Receipt> read_receipt(const std::filesystem::path& file) {
  Receipt receipt;
  const std::optional<std::string> text = whole_text(file, receipt.written_ns);
  if (!text) return std::nullopt;
  const std::size_t end = text->rfind("end ");
  if (end == std::string::npos || text->substr(end) != fmt::format("end {}\n", xxh3(text->substr(0, end))))
    return std::nullopt;
  for (Words lines(std::string_view(*text).substr(0, end)); lines.any();) {
    const std::string_view what = lines.until(' ');
    if (what == "recipe") {
      receipt.recipe = lines.until('\n');
    } else if (what == "input") {
      receipt.input = lines.until('\n');
    } else if (what == "output") {
      receipt.output = lines.until('\n');
    } else if (what == "state") {
      receipt.state = state_in(lines, '\n');
    } else if (what == "with") {
      std::string digest(lines.until(' '));
      receipt.made_with.emplace_back(out_of_line(lines.until('\n')), std::move(digest));
    } else {
      ResultValue& results = receipt.results.emplace_back();
      results.name = lines.until(' ');
      if (what == "text")
        results.text = out_of_line(lines.until('\n'));
      else
        results.number = lines.number<double>('\n');
    }
  }
  return receipt;
}

void write_receipt(const std::filesystem::path& file, Receipt receipt, const std::filesystem::path& output) {
  receipt.state = state_of(output);
  const std::string text = text_of(receipt);
  write_text_if_changed(file, text + fmt::format("end {}\n", xxh3(text)), Sync::never);
  // If the text of the receipt did not change, its time is set to now, so that it is younger than the output.
  if (state_of(file).changed_ns <= receipt.state.changed_ns) ::utimensat(AT_FDCWD, file.c_str(), nullptr, 0);
}

void renew_receipt(const std::filesystem::path& file, const std::filesystem::path& output) {
  const std::optional<Receipt> receipt = read_receipt(file);
  const FileState state = state_of(output);
  // The bytes are compared after the state was read, so a later change alters the state.
  if (receipt && checksum_of(output) == receipt->output && state_of(output) == state)
    write_receipt(file, *receipt, output);
}

bool is_as_noted(const Receipt& receipt, const std::filesystem::path& output) {
  const FileState now = state_of(output);
  if (!now.exists()) return false;
  return (receipt.state_suffices() && receipt.state == now) || checksum_of(output) == receipt.output;
}

}  // namespace dresslife::pipeline
