"""The command ./tutorial, the demonstration, the doctor and the picture of the graph."""
