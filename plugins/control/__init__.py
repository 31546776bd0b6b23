"""Control menu of the micro and nano stages."""
