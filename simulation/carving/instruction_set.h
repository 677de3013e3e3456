// Instructions of the processor that the inner loops of milling may use. The choice changes speed, never a
// result: every variant does the same operations in the same order, and tests compare them bit for bit.
#pragma once

namespace osteomill {

enum class InstructionSet {
    plain,  ///< instructions that every processor of the target has
    avx2    ///< 256-bit vectors of x86-64
};

inline const char* name_of(InstructionSet set) noexcept {
    return set == InstructionSet::avx2 ? "avx2" : "plain";
}

/// The fastest set that this processor has.
inline InstructionSet best_instruction_set() noexcept {
#if defined(__x86_64__)
    return __builtin_cpu_supports("avx2") ? InstructionSet::avx2 : InstructionSet::plain;
#else
    return InstructionSet::plain;
#endif
}

}  // namespace osteomill
