# OSTEOMILL_JOINED_SOURCES: whether the sources of a target are compiled joined, several in one go, so that headers that are long
# to parse are parsed once: what CMake calls a unity build. It is there for runs that compile everything once, and halves their
# time. A change then compiles several files again and a missing include hides, so the preset that one works with, `debug`, leaves
# it off.
option(OSTEOMILL_JOINED_SOURCES "Compile several sources of a target in one go")

# osteomill_join(NAME IS_SEPARATE): for a target of this folder. IS_SEPARATE: its files give one name to several things, each in a
# namespace without a name, and cannot be joined.
function(osteomill_join name is_separate)
    if(OSTEOMILL_JOINED_SOURCES AND NOT is_separate)
        set_target_properties(${name} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE 8)
    endif()
endfunction()
