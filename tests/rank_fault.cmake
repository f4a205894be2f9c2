# One of two ranks fails while the other waits for it: all end, with its message and exit code.
execute_process(COMMAND ${MPIRUN} --allow-run-as-root --oversubscribe -np 2 ${PROGRAM}
                RESULT_VARIABLE code ERROR_VARIABLE errors OUTPUT_QUIET TIMEOUT 60)
if(NOT code EQUAL 3)
  message(FATAL_ERROR "exit code ${code} instead of 3:\n${errors}")
endif()
if(NOT errors MATCHES "plumbline: memory ran out: .* \\(on rank 1 alone; the others have not come")
  message(FATAL_ERROR "the message of rank 1 is missing:\n${errors}")
endif()
