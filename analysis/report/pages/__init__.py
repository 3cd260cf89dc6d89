"""Pages of the other commands. parts(data, page) returns title, sentence, answer and sections."""
