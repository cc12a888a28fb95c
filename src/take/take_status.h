#pragma once
#include <string>

namespace windfall::take {

/// How far a take is. `Running` also stands in the folder of a run that was killed.
enum class TakeStatus { Running, Complete, Cancelled, Failed };

/// "running", "complete", "cancelled", "failed": the words of take.json.
const char* to_text(TakeStatus status);

}  // namespace windfall::take
