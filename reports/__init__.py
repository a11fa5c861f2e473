"""One offline HTML page for each study."""
