"""What is made of a diagnosis: text, JSON, web page, corrected model, prediction."""
