# A scene that the command must refuse: with an exit code, saying why, and leaving nothing behind.
# usage: cmake -DPLUMBLINE=... -DCOMMAND=run -DSCENE=... -DOUTPUT=... -P refused.cmake
# The scene has a line '# Refused: CODE, TEXT', the TEXT being part of what is said.
file(STRINGS ${SCENE} refused REGEX "^# Refused: " LIMIT_COUNT 1)
if(NOT refused MATCHES "^# Refused: ([0-9]+), (.+)$")
  message(FATAL_ERROR "${SCENE}: write '# Refused: CODE, TEXT'")
endif()
set(code ${CMAKE_MATCH_1})
set(text ${CMAKE_MATCH_2})

file(REMOVE_RECURSE ${OUTPUT})
execute_process(COMMAND ${PLUMBLINE} ${COMMAND} ${SCENE} --quiet -o ${OUTPUT}
                RESULT_VARIABLE result OUTPUT_QUIET ERROR_VARIABLE said)
if(NOT result EQUAL code)
  message(FATAL_ERROR "exit code ${result} instead of ${code}: ${said}")
endif()
string(FIND "${said}" "${text}" place)
if(place EQUAL -1)
  message(FATAL_ERROR "'${text}' is not in: ${said}")
endif()
if(EXISTS ${OUTPUT})
  message(FATAL_ERROR "${OUTPUT} is left behind")
endif()
