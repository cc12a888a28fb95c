#pragma once
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

namespace windfall::cli {

/// The processor's name, as the system tells it.
std::string processor_name();

/// Cores that this process may use.
int usable_threads();

/// Bytes of memory that are free for a new program, within the limits of a container; empty when unknown.
std::optional<std::uint64_t> available_memory_bytes();

/// Where a program is found on the PATH; empty when it is not there.
std::filesystem::path find_program(const std::string& name);

/// "1.5 GiB".
std::string bytes_text(std::uint64_t bytes);

}  // namespace windfall::cli
