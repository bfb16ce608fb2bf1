#pragma once

namespace welkin {

/// Instruction sets that some source files are compiled for besides the baseline.
enum class InstructionSet { baseline, avx2 };

/// The best set that this build has and this processor runs, unless WELKIN_INSTRUCTION_SET=baseline is in the
/// environment (for tests and comparisons). Decided once.
InstructionSet instruction_set();

/// Whether code for avx2 may use F16C too: conversions between halves and floats.
bool has_f16c();

}  // namespace welkin
