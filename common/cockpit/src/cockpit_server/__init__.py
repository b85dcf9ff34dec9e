"""The server of the page: what it shows, who drives, who may."""
