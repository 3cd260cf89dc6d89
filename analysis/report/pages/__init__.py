"""Pages of one kind of answer each: parts(data, page) gives title, sentence, answer and sections."""
