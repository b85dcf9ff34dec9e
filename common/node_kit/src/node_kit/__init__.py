"""What every node of the suite needs: start, end, checked parameters, prompt publishing."""
